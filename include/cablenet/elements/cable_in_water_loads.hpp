#pragma once
#include "cablenet/elements/middle_load.hpp"
#include "cablenet/elements/wet_part.hpp"

/// The loads of cable_in_water.hpp in the form that the loop over elements inlines.  The type of the water leaves out
/// at compile time what that water does not have.  Source and tests: see cable_in_water.hpp.
namespace cablenet::elements {

/// What acts on node i across the cable beside n_i p, over the element's length: added mass times the acceleration that
/// it meets, and the couple by which drag slows the chord's turning.  [N/m]
template <class Water>
Vector3 uneven_load(const CableInWater& c, const WetPart& wet, const EndMotion& m, const MiddleLoad& middle,
                    std::size_t i) {
  const Vector3 a = wet.m[i][0] * m.a[0] + wet.m[i][1] * m.a[1];
  const double slowing = (i == 0 ? 1 : -1) * wet.spread() * middle.flow.slowing();
  const Vector3 couple = slowing * (m.v[1] - m.v[0]);
  if constexpr (Water::varies) return c.added * (wet.n[i] * middle.water.acceleration - a) + couple;
  return couple - c.added * a;
}

/// A node's derivative by another: share times that of the load on the whole element, and that of the uneven load.
/// @param turn  L times the derivative of e by the chord   @param rates  the uneven load falls by it times the motion
inline Matrix3 node_slope(const Vector3& e, double share, const Matrix3& whole, const Vector3& uneven, double turn,
                          double rates) {
  const double along = turn * e.dot(uneven), a = rates + along;
  const Vector3 q = turn * uneven - (a + along) * e;
  Matrix3 by = share * whole - e.lazyProduct(q.transpose());
  by.diagonal().array() -= a;
  return by;
}

/// The derivatives of the loads, where the wetted part stays as it is.
template <class Water>
void set_slopes(const CableInWater& c, double L, const Vector3& e, double l, const WetPart& wet, const EndMotion& m,
                const MiddleLoad& middle, const std::array<Vector3, 2>& uneven, const Shift& f, EndLoads& loads) {
  const CrossFlow& flow = middle.flow;
  const Matrix3 chord = L * f.x / l * flow.by_axis();
  Matrix3 point = -L * f.v * flow.by_flow();
  Vector3 faster = -f.v * flow.slowing_by_flow();
  if constexpr (Water::varies) {
    point += L * f.x * by_place(c, e, middle);
    faster += f.x * (middle.water.velocity_slope.transpose() * flow.slowing_by_flow());
  }
  const double at = Water::has_surface ? wet.middle() : 0.5, turn = L * f.x / l, mass = L * c.added * f.a;
  const double couple = L * wet.spread() * flow.slowing() * f.v;
  const Matrix3 by0 = (1 - at) * point - chord, by1 = at * point + chord;
  loads.by[0][0] = node_slope(e, wet.n[0], by0, uneven[0], -turn, mass * wet.m[0][0] + couple);
  loads.by[0][1] = node_slope(e, wet.n[0], by1, uneven[0], turn, mass * wet.m[0][1] - couple);
  loads.by[1][0] = node_slope(e, wet.n[1], by0, uneven[1], -turn, mass * wet.m[1][0] - couple);
  loads.by[1][1] = node_slope(e, wet.n[1], by1, uneven[1], turn, mass * wet.m[1][1] + couple);
  // The couple also grows with the flow across the middle.
  const Vector3 turning = L * wet.spread() * across(e, m.v[1] - m.v[0]), axis = f.x / l * flow.slowing_by_axis();
  const Matrix3 by_first = turning * ((1 - at) * faster - axis).transpose();
  const Matrix3 by_second = turning * (at * faster + axis).transpose();
  loads.by[0][0] += by_first, loads.by[1][0] -= by_first;
  loads.by[0][1] += by_second, loads.by[1][1] -= by_second;
}

/// Adds to the derivatives that the wetted part grows and its middle moves.
inline void add_wetting(const CableInWater& c, double L, const Vector3& e, const EndMotion& m, const WetPart& wet,
                        const std::array<WetHalf, 2>& halves, const MiddleLoad& middle, const Shift& f,
                        EndLoads& loads) {
  const CrossFlow& flow = middle.flow;
  const double at = wet.middle();
  const Vector3 p = middle.p + c.added * across(e, middle.water.acceleration), w = m.v[1] - m.v[0], d = m.x[1] - m.x[0];
  const Vector3 by_middle = by_place(c, e, middle) * d - flow.by_flow() * w;
  const double slowing_by_middle = flow.slowing_by_flow().dot(middle.water.velocity_slope * d - w);
  for (std::size_t h = 0; h < 2; ++h) {
    const double n0 = half_integral(h, 0), n1 = half_integral(h, 1), moved = (1 - at) * n1 - at * n0;
    const double spread = half_integral(h, 1, 1) - 2 * at * n1 + at * at * (n0 + n1);
    const Vector3 couple =
        (spread * flow.slowing() + wet.spread() / wet.length() * moved * slowing_by_middle) * across(e, w);
    for (std::size_t i = 0; i < 2; ++i) {
      const Vector3 a = half_integral(h, i, 0) * m.a[0] + half_integral(h, i, 1) * m.a[1];
      const double share = i == 0 ? 1 - at : at;
      const Vector3 gain =
          half_integral(h, i) * p + share * moved * by_middle - c.added * across(e, a) + (i == 0 ? 1 : -1) * couple;
      for (std::size_t k = 0; k < 2; ++k) loads.by[i][k] += L * f.x * gain * halves[h].by[k].transpose();
    }
  }
}

template <bool with_tangent, class Water>
[[gnu::flatten]] EndLoads water_loads(const CableInWater& c, double L, const EndMotion& m, const Water& water,
                                      const Shift& f) {
  const Vector3 d = m.x[1] - m.x[0];
  const double l = d.norm();
  const Vector3 e = 1 / l * d;
  WetPart wet;
  std::array<WetHalf, 2> halves{};
  if constexpr (Water::has_surface) {
    for (std::size_t h = 0; h < 2; ++h) halves[h] = wet_half(water.fluid, water.t, c.diameter, m.x, h);
    wet = wet_part(halves);
    if (wet.length() <= 0) return no_loads();
  }
  const MiddleLoad middle = middle_load(c, e, m, Water::has_surface ? wet.middle() : 0.5, water);
  EndLoads loads;
  std::array<Vector3, 2> uneven;
  for (std::size_t i = 0; i < 2; ++i) {
    uneven[i] = uneven_load<Water>(c, wet, m, middle, i);
    loads.on[i] = L * (wet.n[i] * middle.p + across(e, uneven[i]));
  }
  if constexpr (with_tangent) {
    set_slopes<Water>(c, L, e, l, wet, m, middle, uneven, f, loads);
    if constexpr (Water::has_surface)
      if (wet.length() < 1) add_wetting(c, L, e, m, wet, halves, middle, f, loads);
  }
  return loads;
}

}   // namespace cablenet::elements
