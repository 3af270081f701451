#pragma once
#include <array>

#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/base/shift.hpp"
#include "cablenet/elements/cable_data.hpp"
#include "cablenet/environment/fluid.hpp"

/// What water does to a two-node cable element: Morison's drag, added mass normal to the cable, buoyancy and the
/// waves' pressure gradient, per unstretched length, integrated with two Gauss points.
/// With e = d/l, u and w the water's velocity and acceleration less the cable's, un = u - e (e.u), ut = e.u:
///   p = wet [ 1/2 rho Cdn d |un| un + 1/2 rho Cdt pi d |ut| ut e + rho A Ca (w - e (e.w)) + rho A (g ez + a_water) ]
/// where wet is the wetted fraction of the half element around the Gauss point, under the water's height there (1
/// without a surface).  The added mass matrix is thus consistent, as the cable's own.
/// Source: Morison et al., Petroleum Trans. AIME 189 (1950) 149; MoorDyn's documentation for cables.
/// Tests: tests/unit/cable_in_water_test.cpp
namespace cablenet::elements {

/// The motion of an element's two nodes.
struct EndMotion {
  std::array<Vector3, 2> x, v, a;
};

/// Loads on the two nodes [N] and on[i]'s derivatives by node j's unknowns.
struct EndLoads {
  std::array<Vector3, 2> on;
  std::array<std::array<Matrix3, 2>, 2> by;
};

/// Water of one velocity everywhere.
struct UniformWater {
  static constexpr bool varies = false, has_surface = false;
  Vector3 velocity;
  double gravity;   ///< [m/s^2]
};
/// Water that varies with place and time, up to a surface where the fluid has one.
template <bool surface>
struct VaryingWater {
  static constexpr bool varies = true, has_surface = surface;
  const environment::Fluid& fluid;
  double t;         ///< [s]
  double gravity;   ///< [m/s^2]
};

/// In cable_in_water_loads.hpp.
/// @param L unstretched length [m]   @returns loads; without tangent `by` is not set
template <bool with_tangent, class Water>
EndLoads water_loads(const CableInWater&, double L, const EndMotion&, const Water&, const Shift&);

}   // namespace cablenet::elements
