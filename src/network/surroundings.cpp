#include "cablenet/network/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cablenet/scene/scene.hpp"

namespace cablenet::network {
namespace {

/// The smoothing over the depth to which a cable sinks into the bed under its own weight.  It is less than 1, so that a
/// cable at rest lies where stiffness is constant.
constexpr double smoothing_part = 0.2;

/// What lies on the bed travels before it slips.  On a hard bed it travels mu times this part of its diameter, so
/// little that friction soon holds all that it can.  A soft bed lets it sink in, and gives way more.  So the depth
/// beyond `shallow` times the diameter, also times mu, is added to the travel.
constexpr double least_travel = 0.007, shallow = 0.25;

/// The least smoothing over the diameter, for what has no weight.
constexpr double least_smoothing = 1e-6;

elements::CableInWater in_water(const scene::CableType& type, double density) {
  const double displaced = density * type.area, drag = 0.5 * density * type.diameter;
  return {displaced, displaced * type.added_mass, drag * type.normal_drag,
          std::numbers::pi * drag * type.tangential_drag, type.diameter};
}

/// Of what presses the bed.  @param pressure [Pa]   @param size [m]
double smoothing_of(const environment::Bed& bed, double pressure, double size) {
  return std::max(smoothing_part * pressure / bed.stiffness, least_smoothing * size);
}
double friction_stiffness_of(const environment::Bed& bed, double pressure, double size) {
  if (bed.friction_stiffness > 0) return bed.friction_stiffness;
  const double depth = pressure / bed.stiffness, travel = least_travel * size + std::max(depth - shallow * size, 0.0);
  return pressure > 0 ? pressure / travel : bed.stiffness;
}
/// The damping of friction over its stiffness [s].  It is the bed's own ratio, but at most that which damps a weight at
/// rest critically.  More damping would only act as more stiffness.
double delay_of(const environment::Bed& bed, double pressure, double grip, double gravity) {
  const double of_bed = bed.damping / bed.stiffness;
  return gravity > 0 ? std::min(of_bed, 2 * std::sqrt(std::max(pressure, 0.0) / (grip * gravity))) : of_bed;
}

CableOnBed on_bed(const scene::CableType& type, const environment::Bed& bed, double density, double gravity) {
  const double pressure = gravity * (type.mass_per_length - density * type.area) / type.diameter;
  const double grip = friction_stiffness_of(bed, pressure, type.diameter);
  return {type.diameter, smoothing_of(bed, pressure, type.diameter), grip, delay_of(bed, pressure, grip, gravity)};
}

}   // namespace

Surroundings make_surroundings(const scene::Scene& scene) {
  Surroundings result{scene.fluid, scene.bed, {}, {}};
  const double density = scene.fluid ? scene.fluid->density : 0;
  for (const auto& type : scene.cable_types) {
    if (scene.fluid) result.in_water.push_back(in_water(type, density));
    if (scene.bed) result.on_bed.push_back(on_bed(type, *scene.bed, density, scene.gravity));
  }
  return result;
}

BedSpot<SceneNode> bed_spot(const SpotShape& shape, SceneNode node, double weight, const scene::Scene& scene) {
  const double pressure = weight / shape.area, grip = friction_stiffness_of(*scene.bed, pressure, shape.size);
  return {node,       shape.radius,
          shape.area, smoothing_of(*scene.bed, pressure, shape.size),
          grip,       delay_of(*scene.bed, pressure, grip, scene.gravity)};
}

SpotShape sphere(double radius) { return {radius, std::numbers::pi * radius * radius, 2 * radius}; }

std::optional<BedSpot<SceneNode>> bed_spot_of(const scene::Point& point, SceneNode node, const scene::Scene& scene) {
  const double radius = point.contact_radius.value_or(wetted_radius(point.volume, 0));
  if (!scene.bed || point.motion || radius == 0) return std::nullopt;
  const double displaced = scene.fluid ? scene.fluid->density * point.volume : 0;
  const double weight = std::max(scene.gravity * (point.mass - displaced), 0.0);
  return bed_spot(sphere(radius), node, weight, scene);
}

double wetted_radius(double volume, double area) {
  return volume > 0 ? std::cbrt(0.75 / std::numbers::pi * volume) : std::sqrt(area / std::numbers::pi);
}

bodies::PointInWater point_in_water(const scene::Point& point, double density) {
  return {density * point.volume, 0.5 * density * point.drag_area, point.added_mass,
          wetted_radius(point.volume, point.drag_area)};
}

}   // namespace cablenet::network
