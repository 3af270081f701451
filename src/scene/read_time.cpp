#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "parts.hpp"
#include "rows.hpp"
#include "spelling.hpp"

namespace cablenet::scene {

namespace {

constexpr double most_steps = 2147483647;
/// Of energy_momentum, and the radius of the others.
constexpr double default_dissipation = 0.0053, default_radius = 0.8;

struct AdaptiveKeys {
  double tolerance = 0;
};
const Table<AdaptiveKeys> adaptive_table("A step that follows the motion.",
                                         {{"tolerance", number("m", above(0)), required,
                                           "The local error of positions that a step may make.",
                                           &AdaptiveKeys::tolerance}},
                                         Holds::any_keys, "{tolerance: a number > 0 [m]}");

double read_tolerance(const Value& adaptive) {
  if (!adaptive.node.IsMap())
    adaptive.refuse(adaptive_table.expected, "Write adaptive: {tolerance: 1.0e-5}, the local error of a step.");
  AdaptiveKeys keys;
  read_rows(adaptive, adaptive_table, keys);
  return keys.tolerance;
}

/// A scheme and its radius mean more where they are given.
struct TimeKeys : Time {
  std::optional<Scheme> given_scheme;
  std::optional<double> given_radius;
};
const Table<TimeKeys> time_table(
    "How the scene goes through time.",
    {{"start", number("s"), standard, "The time at the start.", &TimeKeys::start},
     {"end", number("s"), required, "The time at the end, which is later than start.", &TimeKeys::end},
     {"step", number("s", above(0)), absent("required without accuracy, which chooses it"),
      "The time step; the first one where it is adaptive.", &TimeKeys::step},
     {"adaptive", later(section_form(adaptive_table)), absent("all steps are equal"),
      "Lets the step follow the motion.",
      [](Time& time, const Value& value) { time.tolerance = read_tolerance(value); }},
     {"scheme", choice<Scheme>(), absent("energy_momentum"), "The time stepping scheme.", &TimeKeys::given_scheme},
     {"spectral_radius", number("", between(0, 1)), absent("1 with energy_momentum, 0.8 with the others"),
      "How much of a vibration that is too fast for the step is left after a step: 0 damps most, 1 nothing.",
      &TimeKeys::given_radius}});

/// A scheme that is named, or a radius of 1, asks that nothing be removed.
void settle_scheme(TimeKeys& time) {
  const bool is_default = !time.given_scheme && !time.given_radius;
  time.scheme = time.given_scheme.value_or(Scheme::energy_momentum);
  const bool conserves = time.scheme == Scheme::energy_momentum;
  time.spectral_radius = time.given_radius.value_or(conserves ? 1 : default_radius);
  time.axial_dissipation = conserves && (is_default || time.spectral_radius < 1) ? default_dissipation : 0;
}

void check_steps(const Section& section, const Time& time) {
  if (!(time.end > time.start))
    section.find("end")->refuse(fmt::format("a number > start, which is {} [s]", time.start), "Correct end or start.");
  const double duration = time.end - time.start;
  if (section.find("step") == nullptr) return;
  const Value& step = *section.find("step");
  if (time.step > duration * (1 + 1e-12))
    step.refuse(fmt::format("a number <= end - start, which is {} [s]", duration), "Make the step smaller.");
  // An adaptive step may start as small as it likes.
  if (!time.tolerance && !(duration / time.step < most_steps))
    step.refuse(fmt::format("at most {:.0f} steps from start to end", most_steps), "Make the step larger.");
}

const std::string history_expected = "a list of names of points, bodies and cables";
const std::string history_item = "a name of a point, a body or a cable; one with brackets in quotes";

const std::string stiffness_expected = "a list of names of points and bodies";
const std::string stiffness_item = "a name of a point or a body; one with brackets in quotes";

struct OutputKeys : Output {
  std::optional<double> given_interval;
  std::optional<Value> given_history, given_stiffness;
};
const Table<OutputKeys> output_table(
    "What is written while the scene is solved.",
    {{"interval", number("s", at_least(0)), absent("a hundredth of the time from start to end"),
      "The time between saved frames and rows of the history; 0 saves every step.", &OutputKeys::given_interval},
     {"history", later(list_form(history_expected, text(history_item).form)), absent("none"),
      "The points, bodies and cables whose motion and tension are written to history.csv.", &OutputKeys::given_history},
     {"energy", boolean(), standard, "Whether the history holds the energy of the whole and its parts.",
      &OutputKeys::energy},
     {"stiffness", later(list_form(stiffness_expected, text(stiffness_item).form)), absent("none"),
      "The points and bodies whose stiffness in the equilibrium, with all else in equilibrium, is written to "
      "stiffness.csv and run.yaml.",
      &OutputKeys::given_stiffness}});

[[noreturn]] void fail_history(const Value& item, const std::string& name, const SceneNames& names) {
  if (names.nets.has(name)) item.fail(fmt::format("{} is a net; expected points, bodies and cables. Remove it.", name));
  const std::string stem = name.substr(0, name.find('.'));
  if (names.bodies.find(stem))
    item.fail(fmt::format("{} is not allowed; expected {}, the body as a whole. Write {}.", name, stem, stem));
  std::vector<std::string> known = names.points.all();
  for (const Names* more : {&names.bodies, &names.cables})
    known.insert(known.end(), more->all().begin(), more->all().end());
  item.fail(fmt::format("{} is no point, body or cable; expected one of: {}.{} Correct or remove it.", name,
                        listed(known), did_you_mean(name, known)));
}

using Kinds = std::vector<std::pair<HistoryKind, const Names*>>;

/// @param fail  refuses a name of none of these kinds
template <class Fail>
std::vector<HistoryItem> read_items(const Value& value, const std::string& list, const std::string& one,
                                    const Kinds& kinds, Fail fail) {
  std::vector<HistoryItem> items;
  std::set<std::pair<HistoryKind, int>> seen;
  for (const Value& item : read_list(value, list)) {
    const std::string name = read_text(item, one);
    const auto has_name = [&](const auto& entry) { return entry.second->find(name).has_value(); };
    const auto found = std::find_if(kinds.begin(), kinds.end(), has_name);
    if (found == kinds.end()) fail(item, name);
    const auto [first, count] = *found->second->find(name);
    for (int i = first; i < first + count; ++i) {
      if (!seen.insert({found->first, i}).second)
        item.fail(fmt::format("{} is already in the list; expected each once. Remove it.", name));
      items.push_back({found->first, i});
    }
  }
  return items;
}

void read_history(const Value& value, const SceneNames& names, Output& output) {
  output.history = read_items(
      value, history_expected, history_item,
      {{HistoryKind::point, &names.points}, {HistoryKind::body, &names.bodies}, {HistoryKind::cable, &names.cables}},
      [&](const Value& item, const std::string& name) { fail_history(item, name, names); });
}

void read_stiffness(const Value& value, const Scene& scene, const SceneNames& names, Output& output) {
  if (!scene.starts_static)
    value.fail(
        "is not allowed in a run from rest; expected one from an equilibrium, as the stiffness is that of an "
        "equilibrium. Give initial: static, or no time, or remove it.");
  const auto fail = [&](const Value& item, const std::string& name) {
    std::vector<std::string> known = names.points.all();
    known.insert(known.end(), names.bodies.all().begin(), names.bodies.all().end());
    item.fail(fmt::format("{} is no point or body; expected one of: {}.{} Correct or remove it.", name, listed(known),
                          did_you_mean(name, known)));
  };
  output.stiffness = read_items(value, stiffness_expected, stiffness_item,
                                {{HistoryKind::point, &names.points}, {HistoryKind::body, &names.bodies}}, fail);
}

}   // namespace

Form time_form() { return section_form(time_table); }
Form output_form() { return section_form(output_table); }

Time read_time(const Value& value, const Scene& scene) {
  TimeKeys time;
  const Section section = read_rows(value, time_table, time);
  if (!scene.accuracy) section.require("step", ", as there is no accuracy by which it is chosen");
  check_steps(section, time);
  settle_scheme(time);
  return time;
}

Output read_output(const std::optional<Value>& value, const Scene& scene, const SceneNames& names) {
  OutputKeys output;
  if (value) read_rows(*value, output_table, output);
  output.interval = output.given_interval.value_or((scene.time.end - scene.time.start) / 100);
  if (output.given_history) read_history(*output.given_history, names, output);
  if (output.given_stiffness) read_stiffness(*output.given_stiffness, scene, names, output);
  return output;
}

}   // namespace cablenet::scene
