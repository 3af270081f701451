#pragma once
#include <optional>
#include <vector>

#include "cablenet/bodies/body_data.hpp"
#include "cablenet/elements/cable_data.hpp"
#include "cablenet/environment/bed.hpp"
#include "cablenet/environment/fluid.hpp"

namespace cablenet::scene {
struct Scene;
struct Point;
}   // namespace cablenet::scene

/// The surroundings of a network are a fluid and a seabed.  With them stand the properties of cables and points on
/// which their forces depend.
namespace cablenet::network {

/// The properties of a cable on which contact with the bed depends.
struct CableOnBed {
  double diameter;    ///< [m]
  double smoothing;   ///< half the range of depths over which contact sets in [m], > 0
};

/// A node on which water acts directly: a point, or a body's centre of buoyancy.
template <class Node>
struct WetPoint {
  Node node;
  bodies::PointInWater water;
};

struct Surroundings {
  std::optional<environment::Fluid> fluid;
  std::optional<environment::Bed> bed;
  std::vector<elements::CableInWater> in_water;   ///< per material; empty without fluid
  std::vector<CableOnBed> on_bed;                 ///< per material; empty without bed

  bool empty() const { return !fluid && !bed; }
};

Surroundings make_surroundings(const scene::Scene& scene);

/// The radius of the sphere with this volume or, where the volume is 0, with this cross-section.  [m]
double wetted_radius(double volume, double area);
/// @param density of the fluid [kg/m^3]
bodies::PointInWater point_in_water(const scene::Point& point, double density);

}   // namespace cablenet::network
