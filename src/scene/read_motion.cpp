#include <fmt/format.h>

#include <cmath>

#include "cablenet/base/errors.hpp"
#include "expression.hpp"
#include "parts.hpp"

namespace cablenet::scene {

namespace {

/// When the motion is asked for, for messages.
std::string needed_times(const Time& time) {
  if (time.end > time.start) return fmt::format("all of {}..{} s, from time.start to time.end", time.start, time.end);
  return fmt::format("t = {} s, at which a scene without time is solved", time.start);
}

Motion read_waypoints(const Value& value, const Time& time) {
  const std::string expected = "a list of at least 2 rows [t, x, y, z] [s, m, m, m]";
  const std::vector<Value> rows = read_list(value, expected);
  if (rows.size() < 2) value.refuse(expected, "Add rows.");
  std::vector<double> times;
  std::vector<Vector3> positions;
  for (const Value& row : rows) {
    const std::vector<double> numbers = read_numbers(row, 4, "[t, x, y, z], four numbers [s, m, m, m]");
    if (!times.empty() && !(numbers[0] > times.back()))
      row.fail(fmt::format("t = {} is not allowed; expected a time > {}, that of the row before. Sort the rows.",
                           numbers[0], times.back()));
    times.push_back(numbers[0]);
    positions.emplace_back(numbers[1], numbers[2], numbers[3]);
  }
  if (times.front() > time.start || times.back() < time.end)
    value.fail(fmt::format("the rows cover {}..{} s; expected {}. Add rows or {}.", times.front(), times.back(),
                           needed_times(time), time.end > time.start ? "shorten the time" : "shift their times"));
  return Motion::waypoints(times, positions);
}

Motion read_harmonic(const Value& value, const Vector3& position) {
  const Section section(value, {"amplitude", "period", "phase"});
  const Vector3 amplitude = read_vector(section.require("amplitude", "[x, y, z], three numbers [m]"), "m");
  const double period = read_number(section.require("period", "a number > 0 [s]"), Sign::positive, "s");
  const Value* phase = section.find("phase");
  return Motion::harmonic(position, amplitude, period, phase != nullptr ? read_angle(*phase) : 0);
}

/// A root or a logarithm may leave its range on the way; a thousand looks find what a user is likely to write.
void check_finite(const Value& value, const Motion& motion, const Time& time) {
  constexpr int looks = 1000;
  for (int i = 0; i <= looks; ++i) {
    const double t = time.start + (time.end - time.start) * i / looks;
    const Kinematics k = motion.at(t);
    if (!k.x.allFinite() || !k.v.allFinite() || !k.a.allFinite())
      value.fail(fmt::format(
          "position, velocity or acceleration is not finite at t = {} s; expected finite ones at {}. Change "
          "the expression.",
          t, needed_times(time)));
  }
}

Motion read_expression(const Value& value, const Vector3& position, const Time& time) {
  const Section section(value, {"x", "y", "z"});
  std::array<std::string, 3> texts{"0", "0", "0"};
  const char* keys[] = {"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i) {
    const Value* component = section.find(keys[i]);
    if (component == nullptr) continue;
    texts[i] = read_text(*component, "an expression of t");
    try {
      const Expression ignored(texts[i]);
    } catch (const InputError& error) {
      component->fail(error.what());
    }
  }
  const Motion motion = Motion::expression(position, texts);
  check_finite(value, motion, time);
  return motion;
}

}   // namespace

Motion read_motion(const Value& value, const Vector3& position, const Time& time) {
  const std::string expected = "fixed, {velocity: ..}, {waypoints: ..}, {harmonic: ..} or {expression: ..}";
  if (value.node.IsScalar() && value.node.Scalar() == "fixed") return Motion::fixed(position);
  if (!value.node.IsMap()) value.refuse(expected, "Choose one of these; a free point has no motion key.");
  const Section section(value, {"velocity", "waypoints", "harmonic", "expression"});
  if (value.node.size() != 1) value.refuse(expected + ", exactly one of them", "Keep one.");
  if (const Value* velocity = section.find("velocity"))
    return Motion::uniform(position, read_vector(*velocity, "m/s"), time.start);
  if (const Value* waypoints = section.find("waypoints")) return read_waypoints(*waypoints, time);
  if (const Value* harmonic = section.find("harmonic")) return read_harmonic(*harmonic, position);
  return read_expression(*section.find("expression"), position, time);
}

}   // namespace cablenet::scene
