#pragma once
#include <optional>
#include <vector>

#include "cablenet/base/index.hpp"
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
  double diameter;             ///< [m]
  double smoothing;            ///< half the range of depths over which contact sets in [m], > 0
  double friction_stiffness;   ///< pressure of friction, over how far what sticks has travelled [Pa/m], > 0
  double friction_delay;       ///< the damping of friction over its stiffness [s], >= 0
};

/// A node on which water acts directly: a point, or a body's centre of buoyancy.
template <class Node>
struct WetPoint {
  Node node;
  bodies::PointInWater water;
};

/// A node that touches the bed beside cables: a point as a sphere, or a spot of a body.
template <class Node>
struct BedSpot {
  Node node;
  double radius;               ///< how far the spot reaches below its node [m], >= 0
  double area;                 ///< on which the bed presses [m^2], > 0
  double smoothing;            ///< as of CableOnBed [m]
  double friction_stiffness;   ///< likewise [Pa/m]
  double friction_delay;       ///< likewise [s]
};

struct Surroundings {
  std::optional<environment::Fluid> fluid;
  std::optional<environment::Bed> bed;
  std::vector<elements::CableInWater> in_water;   ///< per material; empty without fluid
  std::vector<CableOnBed> on_bed;                 ///< per material; empty without bed

  bool empty() const { return !fluid && !bed; }
};

Surroundings make_surroundings(const scene::Scene& scene);

/// How a spot meets the bed: `radius` and `area` are those of BedSpot, `size` is that of what rests there.  [m], [m^2],
/// [m]
struct SpotShape {
  double radius, area, size;
};
SpotShape sphere(double radius);

/// A spot on which a weight rests.
/// @param weight  on it, less its buoyancy [N]
BedSpot<SceneNode> bed_spot(const SpotShape& shape, SceneNode node, double weight, const scene::Scene& scene);

/// A free point touches the bed as a sphere.
std::optional<BedSpot<SceneNode>> bed_spot_of(const scene::Point& point, SceneNode node, const scene::Scene& scene);

/// The radius of the sphere with this volume or, where the volume is 0, with this cross-section.  [m]
double wetted_radius(double volume, double area);
/// @param density of the fluid [kg/m^3]
bodies::PointInWater point_in_water(const scene::Point& point, double density);

}   // namespace cablenet::network
