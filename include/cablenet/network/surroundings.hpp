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

/// What a network lies in, and what that needs to know of it.
namespace cablenet::network {

/// A cable's material on the bed.
struct CableOnBed {
  double diameter;    ///< [m]
  double smoothing;   ///< over which contact sets in [m], > 0
};

/// A node that water acts on by itself: a point, or a body's centre of buoyancy.
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

/// Of the sphere of that volume or, without one, that cross-section.  [m]
double wetted_radius(double volume, double area);
/// @param density of the fluid [kg/m^3]
bodies::PointInWater point_in_water(const scene::Point& point, double density);

}   // namespace cablenet::network
