#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "parts.hpp"
#include "spelling.hpp"

namespace cablenet::scene {

namespace {

constexpr double most_steps = 2147483647;
constexpr double default_dissipation = 0.05;

double read_radius(const Value& value) {
  const double radius = read_number(value, Sign::not_negative, "");
  if (radius > 1) value.refuse("a number in 0..1", "0 damps most, 1 nothing.");
  return radius;
}

void read_scheme(const Section& section, Time& time) {
  const Value* scheme = section.find("scheme");
  const Value* radius = section.find("spectral_radius");
  if (scheme == nullptr) {
    time.scheme = radius != nullptr ? Scheme::generalized_alpha : Scheme::energy_momentum;
  } else {
    const Scheme schemes[] = {Scheme::energy_momentum, Scheme::generalized_alpha, Scheme::plain};
    time.scheme = schemes[read_choice(*scheme, {"energy_momentum", "generalized_alpha", "plain"})];
  }
  if (time.scheme == Scheme::energy_momentum) {
    if (radius != nullptr)
      radius->fail("energy_momentum has none. Remove spectral_radius, or choose scheme: generalized_alpha.");
    time.axial_dissipation = scheme != nullptr ? 0 : default_dissipation;
    time.spectral_radius = 1;
  } else {
    time.spectral_radius = radius != nullptr ? read_radius(*radius) : 0.8;
  }
}

double read_tolerance(const Value& adaptive) {
  if (!adaptive.node.IsMap())
    adaptive.refuse("{tolerance: a number > 0 [m]}", "Write adaptive: {tolerance: 1.0e-5}, the local error of a step.");
  const Section section(adaptive, {"tolerance"});
  return read_number(section.require("tolerance", "a number > 0 [m], the local error of a step"), Sign::positive, "m");
}

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

void read_history(const Value& value, const SceneNames& names, Output& output) {
  const std::pair<HistoryKind, const Names*> kinds[] = {
      {HistoryKind::point, &names.points}, {HistoryKind::body, &names.bodies}, {HistoryKind::cable, &names.cables}};
  std::set<std::pair<HistoryKind, int>> seen;
  for (const Value& item : read_list(value, "a list of names of points, bodies and cables")) {
    const std::string name = read_text(item, "a name of a point, a body or a cable; one with brackets in quotes");
    const auto has_name = [&](const auto& entry) { return entry.second->find(name).has_value(); };
    const auto found = std::find_if(std::begin(kinds), std::end(kinds), has_name);
    if (found == std::end(kinds)) fail_history(item, name, names);
    const auto [first, count] = *found->second->find(name);
    for (int i = first; i < first + count; ++i) {
      if (!seen.insert({found->first, i}).second)
        item.fail(fmt::format("{} is already in the list; expected each once. Remove it.", name));
      output.history.push_back({found->first, i});
    }
  }
}

}   // namespace

Time read_time(const Section& top) {
  Time time;
  const Value* value = top.find("time");
  if (value == nullptr) return time;
  const Section section(*value, {"start", "end", "step", "adaptive", "scheme", "spectral_radius"});
  if (const Value* start = section.find("start")) time.start = read_number(*start, Sign::any, "s");
  const Value& end = section.require("end", "a number > start [s]");
  time.end = read_number(end, Sign::any, "s");
  if (!(time.end > time.start))
    end.refuse(fmt::format("a number > start, which is {} [s]", time.start), "Correct end or start.");
  const Value& step = section.require("step", "a number > 0 [s]");
  time.step = read_number(step, Sign::positive, "s");
  const double duration = time.end - time.start;
  if (time.step > duration * (1 + 1e-12))
    step.refuse(fmt::format("a number <= end - start, which is {} [s]", duration), "Make the step smaller.");
  if (const Value* adaptive = section.find("adaptive")) time.tolerance = read_tolerance(*adaptive);
  // An adaptive step may start as small as it likes.
  if (!time.tolerance && !(duration / time.step < most_steps))
    step.refuse(fmt::format("at most {:.0f} steps from start to end", most_steps), "Make the step larger.");
  read_scheme(section, time);
  return time;
}

Output read_output(const Section& top, const Time& time, const SceneNames& names) {
  Output output;
  output.interval = (time.end - time.start) / 100;
  const Value* value = top.find("output");
  if (value == nullptr) return output;
  const Section section(*value, {"interval", "history", "energy"});
  if (const Value* interval = section.find("interval"))
    output.interval = read_number(*interval, Sign::not_negative, "s");
  if (const Value* energy = section.find("energy")) output.energy = read_boolean(*energy);
  if (const Value* history = section.find("history")) read_history(*history, names, output);
  return output;
}

}   // namespace cablenet::scene
