#include "cablenet/scene/read.hpp"

#include <fmt/format.h>

#include "parts.hpp"
#include "rows.hpp"

namespace cablenet::scene {

/// The state that a run starts from.
enum class Initial { rest, equilibrium };
template <>
inline constexpr std::array<Choice<Initial>, 2> choices<Initial>{
    {{Initial::rest, "rest"}, {Initial::equilibrium, "static"}}};

namespace {

/// Sections are read one after the other, as most depend on some before.
struct TopKeys {
  std::string title;
  std::optional<Value> environment, cable_types, points, bodies, cables, nets, time, output;
  std::optional<Initial> initial;
  std::optional<double> accuracy;
};

const Table<TopKeys>& top_table() {
  static const Table<TopKeys> table(
      "A scene.",
      {{"title", text("a text"), absent("none"), "What the scene is called.", &TopKeys::title},
       {"environment", later(environment_form()), absent("gravity alone"), "What surrounds the cables.",
        &TopKeys::environment},
       {"cable_types", later(cable_types_form()), absent("allowed without cables and nets only"),
        "What cables are made of.", &TopKeys::cable_types},
       {"points", later(points_form()), absent("none"), "Points where cables end.", &TopKeys::points},
       {"bodies", later(bodies_form()), absent("none"), "Rigid bodies.", &TopKeys::bodies},
       {"cables", later(cables_form()), absent("none"), "Cables.", &TopKeys::cables},
       {"nets", later(nets_form()), absent("none"), "Nets.", &TopKeys::nets},
       {"initial", choice<Initial>(), absent("rest; static in a scene without time"),
        "Whether a run starts as drawn (rest) or from the equilibrium (static).", &TopKeys::initial},
       {"time", later(time_form()), absent("the equilibrium is the result"), "How the scene goes through time.",
        &TopKeys::time},
       {"accuracy", number("", between(1e-4, 0.1)), absent("elements and time.step are given"),
        "The error of each quantity of the history that is wanted, of its range. Elements and the step that are "
        "absent are chosen for it, by runs with coarser ones.",
        &TopKeys::accuracy},
       {"output", later(output_form()), absent("100 frames and an empty history"), "What is written.",
        &TopKeys::output}});
  return table;
}

bool starts_static(const Section& top, const TopKeys& keys) {
  if (!keys.initial) return !keys.time;
  if (*keys.initial == Initial::rest && !keys.time)
    top.find("initial")->fail(
        "rest is not allowed; expected static or no initial at all, as a scene without time is solved for its "
        "equilibrium. Remove it, or add time: {end, step}.");
  return *keys.initial == Initial::equilibrium;
}

/// All stand in the history's header, where they could not be told apart.
void check_distinct(const std::vector<PointDraft>& points, const std::vector<BodyDraft>& bodies,
                    const std::vector<CableDraft>& cables) {
  std::unordered_map<std::string, std::pair<const char*, int>> owners;
  const auto add = [&](const std::string& name, const char* kind, const Value& value) {
    const auto [owner, is_new] = owners.try_emplace(name, kind, value.line);
    if (!is_new)
      value.fail(fmt::format("{} is also the name of a {} (line {}); expected different names. Rename one.", name,
                             owner->second.first, owner->second.second));
  };
  for (const PointDraft& point : points) add(point.thing.name, "point", point.value);
  for (const BodyDraft& body : bodies) add(body.thing.name, "body", body.value);
  for (const CableDraft& cable : cables) add(cable.cable.name, "cable", cable.value);
}

std::vector<CableType> types_of(const Section& top, const TopKeys& keys, const Scene& scene, Names& names) {
  if (keys.cables || keys.nets) top.require("cable_types");
  return keys.cable_types ? read_cable_types(*keys.cable_types, scene, names) : std::vector<CableType>{};
}

}   // namespace

const KeyTable& scene_keys() { return top_table(); }

Scene read_scene(const std::string& text, const std::string& file) {
  TopKeys keys;
  const Section top = read_rows(parse_yaml(text, file), top_table(), keys);
  Scene scene;
  SceneNames names;
  std::vector<PointDraft> points;
  std::vector<BodyDraft> bodies;
  std::vector<CableDraft> cables;
  scene.file = file;
  scene.text = text;
  scene.title = keys.title;
  scene.accuracy = keys.accuracy;
  if (keys.environment) read_environment(*keys.environment, scene);
  scene.is_static = !keys.time;
  scene.starts_static = starts_static(top, keys);
  if (keys.time) scene.time = read_time(*keys.time, scene);
  scene.cable_types = types_of(top, keys, scene, names.types);
  if (keys.points) points = read_points(*keys.points, scene.time);
  if (keys.bodies) bodies = read_bodies(*keys.bodies);
  if (keys.cables) cables = read_cables(*keys.cables, scene, names.types);
  if (keys.nets) scene.nets = read_nets(*keys.nets, names.types, names.nets);
  if (cables.empty() && scene.nets.empty() && bodies.empty())
    top.map().fail(
        "cables: the scene has neither cables nor nets nor bodies; expected at least one. Add cables, nets or bodies.");
  check_distinct(points, bodies, cables);
  check_size(cables, scene.nets, top.map());
  check_pretensions(cables, keys.nets, scene);
  check_circles(cables);
  mark_repeated(cables, points, bodies);
  scene.points = expand_points(points, names.points);
  scene.bodies = expand_bodies(bodies, names.bodies);
  scene.cables = expand_cables(cables, scene, names);
  check_ends(cables, points, scene);
  scene.output = read_output(keys.output, scene, names);
  scene.notes = water_notes(top, points, bodies, scene);
  add_body_notes(bodies, cables, scene);
  add_force_notes(points, scene);
  add_static_notes(points, bodies, cables, scene);
  return scene;
}

}   // namespace cablenet::scene
