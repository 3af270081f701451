#include <fmt/format.h>

#include "laws.hpp"
#include "parts.hpp"

namespace cablenet::scene {

namespace {

/// A point's motion is made when its position and the scene's time are known.
struct PointKeys : Point {
  std::optional<Vector3> given_position;
  std::optional<ForceKeys> given_force;
  std::optional<MotionKeys> given_motion;
};

const Table<PointKeys>& point_table() {
  static const Table<PointKeys> table(
      "A point where cables end.",
      {{"position", vector("m"), absent("where its waypoints begin; a point without waypoints needs one"),
        "Where the point is drawn.", &PointKeys::given_position},
       {"velocity", vector("m/s"), standard, "The velocity of a free point at the start.", &PointKeys::velocity},
       {"mass", number("kg", at_least(0)), standard, "A mass at the point, beside that of its cables.",
        &PointKeys::mass},
       {"force", force(), absent("there is none"), "A force on the point, in the world's axes.",
        &PointKeys::given_force},
       {"motion", motion(), absent("the point is free"), "How the point is held or moved.", &PointKeys::given_motion},
       Row<PointKeys>("volume", number("m3", at_least(0)), standard, "The water that a free point displaces.",
                      &PointKeys::volume)
           .in_fluid_or_on_bed(),
       Row<PointKeys>("drag_area", number("m2", at_least(0)), standard,
                      "The drag coefficient times the area of a free point, Cd A.", &PointKeys::drag_area)
           .in_fluid(),
       Row<PointKeys>("contact_radius", number("m", at_least(0)), absent("that of a sphere of the point's volume"),
                      "The radius of the sphere as which a free point touches the bed; 0: it does not.",
                      &PointKeys::contact_radius)
           .on_bed(),
       Row<PointKeys>("added_mass", number("kg", at_least(0)), standard, "The added mass of a free point.",
                      &PointKeys::added_mass)
           .in_fluid()});
  return table;
}

/// A point that is held or moved takes neither a velocity nor forces of the water.
void check_moved(const Section& section, const PointKeys& point) {
  const Value* velocity = section.find("velocity");
  const bool is_fixed = !point.given_motion->law;
  if (velocity != nullptr && !(is_fixed && point.velocity.isZero(0)))
    velocity->fail(is_fixed ? "the point is fixed; expected no velocity. Remove velocity, or motion."
                            : "the point's motion says its velocity; expected none here. Remove velocity, or motion.");
  for (const Key& key : point_table().keys) {
    const Value* value = key.needs.empty() ? nullptr : section.find(key.name);
    if (value == nullptr) continue;
    value->fail(
        fmt::format("the point goes where its motion says, so this would do nothing; expected {} of free "
                    "points only. Remove {}, or motion.",
                    key.name, key.name));
  }
}

PointDraft read_point(const Named& named, const Time& time) {
  PointKeys point;
  const Section section = read_rows(named.value, point_table(), point);
  point.name = named.name;
  point.where = named.value.where();
  const bool has_waypoints = point.given_motion && point.given_motion->waypoints;
  if (!has_waypoints) section.require("position");
  point.position = point.given_position.value_or(Vector3::Zero());
  if (point.given_motion) {
    point.motion = make_motion(*point.given_motion, point.position, time);
    check_moved(section, point);
  }
  if (has_waypoints) point.position = point.motion->at(time.start).x;
  if (point.given_force) {
    point.force = point.given_force->constant;
    point.force_law = make_force_law(*point.given_force, time);
  }
  return {point, named.value};
}

}   // namespace

Form points_form() { return map_form("a map from names to points", section_form(point_table())); }

std::vector<PointDraft> read_points(const Value& value, const Time& time) {
  std::vector<PointDraft> points;
  for (const Named& named : read_named(value, points_form().expected)) points.push_back(read_point(named, time));
  return points;
}

}   // namespace cablenet::scene
