#pragma once
#include <array>

#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/base/shift.hpp"
#include "cablenet/elements/cable_data.hpp"
#include "cablenet/environment/fluid.hpp"

/// The forces of water on a two-node cable element: Morison's drag, added mass normal to the cable, buoyancy and the
/// pressure gradient of waves, per unstretched length.
/// The place s on the element goes from 0 at node 1 to 1 at node 2.  Its shape functions are N_1 = 1 - s and N_2 = s.
/// Integrals are over the wetted part of the element.  The load on node i is
///   on_i = L [ n_i p + g_i - e (e.g_i) ]
///   p = 1/2 rho Cdn d |un| un + 1/2 rho Cdt pi d |ut| ut e + rho A (g ez + w)
///   g_i = rho A Ca (n_i w - sum_j m_ij a_j) +/- q 1/2 rho Cdn d |un| turning_share (v_2 - v_1)
///   n_i = integral of N_i,   m_ij = integral of N_i N_j,   q = m_22 - n_2^2/(n_1 + n_2)
/// with e = d/l, u the water's velocity less the cable's, ut = e.u, un = u - e ut, and w the water's acceleration.  u
/// and w are taken once, at the middle of the wetted part, s = n_2/(n_1 + n_2).  At other points the water would cross
/// the chord, where it flows along the curved cable.  The term with turning_share has the sign + on node 1 and - on
/// node 2.  It is a couple that slows the turning of the chord; numerics.md tells why it is there.
///
/// Without a surface n = 1/2, m_11 = m_22 = 1/3,
/// m_12 = 1/6 and q = 1/12; wet_part.hpp has them where an element is partly wet.
/// Source: Morison et al., Petroleum
/// Trans. AIME 189 (1950) 149; MoorDyn's documentation for cables.
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

inline EndLoads no_loads() {
  const Vector3 none = Vector3::Zero();
  const Matrix3 same = Matrix3::Zero();
  return {{none, none}, {{{same, same}, {same, same}}}};
}

/// The loads on an element; cable_in_water_loads.hpp defines it.
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
