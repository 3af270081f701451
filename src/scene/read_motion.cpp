#include "laws.hpp"
#include "parts.hpp"

namespace cablenet::scene {

namespace {

struct HarmonicKeys {
  Vector3 amplitude = Vector3::Zero();
  double period = 0, phase = 0;
};
const Table<HarmonicKeys> harmonic_table(
    "position + amplitude * sin(2 pi t/period + phase).",
    {{"amplitude", vector("m"), required, "The amplitude in each direction.", &HarmonicKeys::amplitude},
     {"period", number("s", above(0)), required, "The period.", &HarmonicKeys::period},
     {"phase", angle(), standard, "The phase at t = 0.", &HarmonicKeys::phase}});

struct MotionKeys {
  std::optional<Vector3> velocity;
  std::optional<TimedRows> waypoints;
  std::optional<HarmonicKeys> harmonic;
  std::optional<WrittenVector> expression;
};
const std::string motion_expected = "fixed, {velocity: ..}, {waypoints: ..}, {harmonic: ..} or {expression: ..}";
const Table<MotionKeys> motion_table(
    "How a point moves.",
    {{"velocity", vector("m/s"), absent(""), "The point leaves its position at time.start and keeps this velocity.",
      &MotionKeys::velocity},
     {"waypoints", timed_rows("m"), absent(""),
      "Rows of time and position, through which the point goes on a smooth (C2 cubic) curve.", &MotionKeys::waypoints},
     {"harmonic", section(harmonic_table), absent(""), "The point swings about its position.", &MotionKeys::harmonic},
     {"expression", written_vector(), absent(""), "The way from its position [m], as expressions of t.",
      &MotionKeys::expression}},
    Holds::one_key, motion_expected);

}   // namespace

Form motion_form() { return either_form(motion_expected, {word_form({"fixed"}), section_form(motion_table)}); }

Motion read_motion(const Value& value, const Vector3& position, const Time& time) {
  if (value.node.IsScalar() && value.node.Scalar() == "fixed") return Motion::fixed(position);
  if (!value.node.IsMap()) value.refuse(motion_expected, "Choose one of these; a free point has no motion key.");
  MotionKeys keys;
  const Section section = read_rows(value, motion_table, keys);
  if (keys.velocity) return Motion::uniform(position, *keys.velocity, time.start);
  if (keys.harmonic)
    return Motion::harmonic(position, keys.harmonic->amplitude, keys.harmonic->period, keys.harmonic->phase);
  if (keys.waypoints) {
    check_covered(*section.find("waypoints"), *keys.waypoints, time);
    return Motion::waypoints(keys.waypoints->times, keys.waypoints->vectors);
  }
  const Motion motion = Motion::expression(position, keys.expression->texts);
  check_finite(*section.find("expression"), motion, time, "position, velocity or acceleration");
  return motion;
}

}   // namespace cablenet::scene
