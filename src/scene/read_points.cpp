#include <fmt/format.h>

#include <tuple>

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

void read_water(const Section& section, Point& point) {
  const std::tuple<const char*, const char*, double&> properties[] = {
      {"volume", "m3", point.volume}, {"drag_area", "m2", point.drag_area}, {"added_mass", "kg", point.added_mass}};
  for (const auto& [key, unit, property] : properties) {
    const Value* value = section.find(key);
    if (value == nullptr) continue;
    property = read_number(*value, Sign::not_negative, unit);
    if (point.motion)
      value->fail(
          fmt::format("the point goes where its motion says, so this would do nothing; expected {} of free "
                      "points only. Remove {}, or motion.",
                      key, key));
  }
}

PointDraft read_point(const Named& named, const Time& time) {
  const Section section(named.value,
                        {"position", "velocity", "mass", "force", "motion", "volume", "drag_area", "added_mass"});
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
  read_water(section, point);
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
