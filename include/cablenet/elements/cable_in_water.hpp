#pragma once
#include <array>

#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/base/shift.hpp"
#include "cablenet/elements/cable_data.hpp"
#include "cablenet/environment/fluid.hpp"

/// The forces of water on a two-node cable element: Morison's drag, added mass normal to the cable, buoyancy and the
/// pressure gradient of waves.  The load p per unstretched length is integrated with two Gauss points.
/// With e = d/l, u and w the water's velocity and acceleration less the cable's, ut = e.u and un = u - e ut:
///   p = wet [ 1/2 rho Cdn d |un| un + 1/2 rho Cdt pi d |ut| ut e + rho A Ca (w - e (e.w)) + rho A (g ez + a_water) ]
/// wet is the wetted fraction of the half element around the Gauss point, below the height of the water at that point;
/// without a surface wet = 1.  The added mass matrix is thus a consistent one, as the cable's mass matrix is.
/// Source: Morison et al., Petroleum Trans. AIME 189 (1950) 149; MoorDyn's documentation for cables.
/// Tests: tests/unit/cable_in_water_test.cpp
namespace cablenet::elements {

/// The motion of an element's two nodes.
struct EndMotion {
  std::array<Vector3, 2> x, v, a;
};

/// The loads on the two nodes [N].  by[i][j] is the derivative of on[i] by the unknowns of node j.
struct EndLoads {
  std::array<Vector3, 2> on;
  std::array<std::array<Matrix3, 2>, 2> by;
};

/// Water with one velocity everywhere.
struct UniformWater {
  static constexpr bool varies = false, has_surface = false;
  Vector3 velocity;
  double gravity;   ///< [m/s^2]
};
/// Water that varies with place and time.  `surface` tells whether the fluid has a surface.
template <bool surface>
struct VaryingWater {
  static constexpr bool varies = true, has_surface = surface;
  const environment::Fluid& fluid;
  double t;         ///< [s]
  double gravity;   ///< [m/s^2]
};

/// The integral of p over an element; cable_in_water_loads.hpp defines it.
/// @param L  unstretched length [m]
/// @returns the loads; `by` is set only where with_tangent is true
template <bool with_tangent, class Water>
EndLoads water_loads(const CableInWater&, double L, const EndMotion&, const Water&, const Shift&);

/// Calls visit(water) with the type of water that the fluid needs, and no richer one.
template <class Visit>
void visit_water(const environment::Fluid& fluid, double t, double gravity, Visit&& visit) {
  if (fluid.surface) return visit(VaryingWater<true>{fluid, t, gravity});
  if (fluid.varies()) return visit(VaryingWater<false>{fluid, t, gravity});
  const Vector3 velocity = fluid.current.empty() ? Vector3(0, 0, 0) : fluid.current.front().velocity;
  visit(UniformWater{velocity, gravity});
}

}   // namespace cablenet::elements
