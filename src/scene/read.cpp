#include "cablenet/scene/read.hpp"

#include <fmt/format.h>

#include "parts.hpp"

namespace cablenet::scene {

namespace {

/// @pre whether the scene is static is known.
bool read_starts_static(const Section& top, bool is_static) {
  const Value* initial = top.find("initial");
  if (initial == nullptr) return is_static;
  if (read_choice(*initial, {"rest", "static"}) == 1) return true;
  if (is_static)
    initial->fail(
        "rest is not allowed; expected static or no initial at all, as a scene without time is solved for its "
        "equilibrium. Remove it, or add time: {end, step}.");
  return false;
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

}   // namespace

Scene read_scene(const std::string& text, const std::string& file) {
  const Section top(parse_yaml(text, file), {"title", "environment", "cable_types", "points", "bodies", "cables",
                                             "nets", "initial", "time", "output"});
  Scene scene;
  scene.file = file;
  scene.text = text;
  if (const Value* title = top.find("title")) scene.title = read_text(*title, "a text");
  read_environment(top, scene);
  scene.is_static = top.find("time") == nullptr;
  scene.starts_static = read_starts_static(top, scene.is_static);
  scene.time = read_time(top);
  SceneNames names;
  scene.cable_types = read_cable_types(top, scene, names.types);
  std::vector<PointDraft> point_drafts = read_points(top, scene.time);
  std::vector<BodyDraft> body_drafts = read_bodies(top);
  const std::vector<CableDraft> cable_drafts = read_cables(top, names.types);
  scene.nets = read_nets(top, names.types, names.nets);
  if (cable_drafts.empty() && scene.nets.empty() && body_drafts.empty())
    top.map().fail(
        "cables: the scene has neither cables nor nets nor bodies; expected at least one. Add cables, nets or bodies.");
  check_distinct(point_drafts, body_drafts, cable_drafts);
  check_size(cable_drafts, scene.nets, top.map());
  check_circles(cable_drafts);
  mark_repeated(cable_drafts, point_drafts, body_drafts);
  scene.points = expand_points(point_drafts, names.points);
  scene.bodies = expand_bodies(body_drafts, names.bodies);
  scene.cables = expand_cables(cable_drafts, scene, names);
  check_ends(cable_drafts, point_drafts, scene);
  scene.notes = water_notes(top, point_drafts, body_drafts, scene);
  add_body_notes(body_drafts, cable_drafts, scene);
  add_static_notes(point_drafts, body_drafts, cable_drafts, scene);
  scene.output = read_output(top, scene.time, names);
  return scene;
}

}   // namespace cablenet::scene
