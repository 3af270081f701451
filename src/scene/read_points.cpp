#include "parts.hpp"

namespace cablenet::scene {

namespace {

bool has_waypoints(const Value* motion) {
  return motion != nullptr && motion->node.IsMap() && motion->node["waypoints"].IsDefined();
}

void read_velocity(const Value& value, const Value* motion, Point& point) {
  point.velocity = read_vector(value, "m/s");
  if (motion == nullptr) return;
  const bool is_fixed = motion->node.IsScalar();
  if (is_fixed && point.velocity.isZero(0)) return;
  value.fail(is_fixed ? "the point is fixed; expected no velocity. Remove velocity, or motion."
                      : "the point's motion says its velocity; expected none here. Remove velocity, or motion.");
}

PointDraft read_point(const Named& named, const Time& time) {
  const char* advice = "Remove it: without fluid it does nothing.";
  const Section section(named.value, {"position", "velocity", "mass", "force", "motion"},
                        {{"volume", advice}, {"drag_area", advice}, {"added_mass", advice}});
  Point point;
  point.name = named.name;
  point.where = named.value.where();
  const Value* motion = section.find("motion");
  if (const Value* position = section.find("position"))
    point.position = read_vector(*position, "m");
  else if (!has_waypoints(motion))
    section.require("position", "[x, y, z], three numbers [m]");
  if (motion != nullptr) point.motion = read_motion(*motion, point.position, time);
  if (has_waypoints(motion)) point.position = point.motion->at(time.start).x;
  if (const Value* velocity = section.find("velocity")) read_velocity(*velocity, motion, point);
  if (const Value* mass = section.find("mass")) point.mass = read_number(*mass, Sign::not_negative, "kg");
  if (const Value* force = section.find("force")) point.force = read_vector(*force, "N");
  return {point, named.value};
}

}   // namespace

std::vector<PointDraft> read_points(const Section& top, const Time& time) {
  std::vector<PointDraft> points;
  const Value* value = top.find("points");
  if (value == nullptr) return points;
  for (const Named& named : read_named(*value, "a map from names to points")) points.push_back(read_point(named, time));
  return points;
}

}   // namespace cablenet::scene
