#include "laws.hpp"

namespace cablenet::scene {

namespace {

using Harmonic = MotionKeys::Harmonic;
const Table<Harmonic> harmonic_table("position + amplitude * sin(2 pi t/period + phase).",
                                     {{"amplitude", vector("m"), required, "The amplitude in each direction.",
                                       &Harmonic::amplitude},
                                      {"period", number("s", above(0)), required, "The period.", &Harmonic::period},
                                      {"phase", angle(), standard, "The phase at t = 0.", &Harmonic::phase}});

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

MotionKeys read_motion(const Value& value) {
  MotionKeys keys;
  if (value.node.IsScalar() && value.node.Scalar() == "fixed") return keys;
  if (!value.node.IsMap()) value.refuse(motion_expected, "Choose one of these; a free point has no motion key.");
  const Section section = read_rows(value, motion_table, keys);
  for (const Key& key : motion_table.keys)
    if (const Value* law = section.find(key.name)) keys.law.emplace(*law);
  return keys;
}

}   // namespace

Kind<MotionKeys> motion() {
  return {either_form(motion_expected, {word_form({"fixed"}), section_form(motion_table)}), read_motion, nullptr};
}

Motion make_motion(const MotionKeys& keys, const Vector3& position, const Time& time) {
  if (keys.velocity) return Motion::uniform(position, *keys.velocity, time.start);
  if (keys.harmonic)
    return Motion::harmonic(position, keys.harmonic->amplitude, keys.harmonic->period, keys.harmonic->phase);
  if (keys.law) return make_law(keys, position, time, "position, velocity or acceleration");
  return Motion::fixed(position);
}

}   // namespace cablenet::scene
