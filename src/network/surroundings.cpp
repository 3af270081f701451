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

/// The least smoothing over the cable's diameter, for cables without weight.
constexpr double least_smoothing = 1e-6;

elements::CableInWater in_water(const scene::CableType& type, double density) {
  const double displaced = density * type.area, drag = 0.5 * density * type.diameter;
  return {displaced, displaced * type.added_mass, drag * type.normal_drag,
          std::numbers::pi * drag * type.tangential_drag, type.diameter};
}

CableOnBed on_bed(const scene::CableType& type, const environment::Bed& bed, double density, double gravity) {
  const double weight = gravity * (type.mass_per_length - density * type.area);
  const double depth = weight / (bed.stiffness * type.diameter);
  return {type.diameter, std::max(smoothing_part * depth, least_smoothing * type.diameter)};
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

double wetted_radius(double volume, double area) {
  return volume > 0 ? std::cbrt(0.75 / std::numbers::pi * volume) : std::sqrt(area / std::numbers::pi);
}

bodies::PointInWater point_in_water(const scene::Point& point, double density) {
  return {density * point.volume, 0.5 * density * point.drag_area, point.added_mass,
          wetted_radius(point.volume, point.drag_area)};
}

}   // namespace cablenet::network
