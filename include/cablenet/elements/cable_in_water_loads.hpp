#pragma once
#include <cmath>
#include <numbers>

#include "cablenet/elements/morison.hpp"

/// The loads of cable_in_water.hpp in the form that the loop over elements inlines.  The type of the water leaves out
/// at compile time what that water does not have.  Source and tests: see cable_in_water.hpp.
namespace cablenet::elements {

/// A Gauss point, in fractions of the element's length.  The shape functions there are N1 = 1 - at and N2 = at.
struct GaussPoint {
  double at;
  double middle;   ///< of the half element around the point
};
constexpr double gauss_offset = 0.5 * std::numbers::inv_sqrt3;
constexpr std::array<GaussPoint, 2> gauss_points{{{0.5 - gauss_offset, 0.25}, {0.5 + gauss_offset, 0.75}}};

inline Vector3 between(const std::array<Vector3, 2>& ends, double at) { return (1 - at) * ends[0] + at * ends[1]; }

/// The wetted fraction of the half element around a Gauss point at x, and its derivatives.
struct HalfWetness {
  double fraction;
  double by_rise = 0;                   ///< by the chord's z [1/m]
  Vector3 by_point = Vector3::Zero();   ///< by x [1/m]
};

inline HalfWetness half_wetness(const environment::Fluid& fluid, double t, double diameter, double dz,
                                const GaussPoint& gauss, const Vector3& x) {
  const double to_middle = gauss.middle - gauss.at, extent = 0.5 * std::abs(dz);
  const double z = x.z() + to_middle * dz, still = *fluid.surface - z;
  if (std::abs(still) >= fluid.reach() + 0.5 * (extent + diameter)) return {still > 0 ? 1.0 : 0.0};
  const environment::SurfaceHeight surface = environment::surface_height(fluid, x, t);
  const environment::Wetness wet = environment::piece_wetness(surface.z - z, extent, diameter);
  const double by_length = dz < 0 ? -0.5 * wet.by_extent : 0.5 * wet.by_extent;
  return {wet.fraction, by_length - to_middle * wet.by_depth, wet.by_depth * (surface.slope - Vector3::UnitZ())};
}

/// Reduces the load on a fully wet cable to the wetted fraction.
template <bool with_tangent>
void wet_in_part(const HalfWetness& wet, const Shift& f, LineLoad& load) {
  if constexpr (with_tangent) {
    load.M *= wet.fraction;
    for (LineSlope* slope : {&load.chord, &load.point}) slope->a *= wet.fraction, slope->q *= wet.fraction;
    load.by_place = wet.fraction * load.by_place + f.x * load.p * wet.by_point.transpose();
    load.by_rise = f.x * wet.by_rise * load.p;
  }
  load.p *= wet.fraction;
}

/// The load p and its derivatives at a Gauss point.
/// @param d  the chord   @param e  d/l
template <bool with_tangent, class Water>
LineLoad line_load(const CableInWater& c, const Vector3& d, const Vector3& e, double l, const GaussPoint& gauss,
                   const EndMotion& m, const Water& water, const Shift& f) {
  const Vector3 v = between(m.v, gauss.at), a = between(m.a, gauss.at);
  if constexpr (!Water::varies) {
    LineLoad load = wet_line_load<with_tangent>(c, e, l, CrossFlow(e, water.velocity - v, -a), f);
    load.p.z() += c.displaced * water.gravity;
    return load;
  } else {
    const Vector3 x = between(m.x, gauss.at);
    HalfWetness wet{1};
    if constexpr (Water::has_surface) wet = half_wetness(water.fluid, water.t, c.diameter, d.z(), gauss, x);
    if (wet.fraction == 0) return no_line_load();
    const environment::WaterMotion motion = environment::water_motion(water.fluid, x, water.t);
    const CrossFlow flow(e, motion.velocity - v, motion.acceleration - a);
    LineLoad load = wet_line_load<with_tangent>(c, e, l, flow, f);
    load.p += c.displaced * (motion.acceleration + water.gravity * Vector3::UnitZ());
    if constexpr (with_tangent) load.by_place = by_place(c, e, flow, load.M, motion, f.x);
    load.by_rise.setZero();
    if (wet.fraction < 1) wet_in_part<with_tangent>(wet, f, load);
    return load;
  }
}

/// The derivative of one node's load by the unknowns of a node.  At each Gauss point g the load's derivative by the
/// chord counts chord[g] times, and its derivative by the point counts point[g] times.
template <bool varies>
Matrix3 node_tangent(const Vector3& e, const LineLoad& load0, const LineLoad& load1, const std::array<double, 2>& chord,
                     const std::array<double, 2>& point) {
  const LineSlope sum0 = sum(chord[0], load0.chord, point[0], load0.point);
  const LineSlope sum1 = sum(chord[1], load1.chord, point[1], load1.point);
  Matrix3 by = sum0.c * load0.M + sum1.c * load1.M + e.lazyProduct((sum0.q + sum1.q).transpose());
  by.diagonal().array() += sum0.a + sum1.a;
  if constexpr (varies) {
    by += point[0] * load0.by_place + point[1] * load1.by_place;
    by.col(2) += chord[0] * load0.by_rise + chord[1] * load1.by_rise;
  }
  return by;
}

template <bool with_tangent, class Water>
[[gnu::flatten]] EndLoads water_loads(const CableInWater& c, double L, const EndMotion& m, const Water& water,
                                      const Shift& f) {
  const Vector3 d = m.x[1] - m.x[0];
  const double l = d.norm();
  const Vector3 e = 1 / l * d;
  const LineLoad load0 = line_load<with_tangent>(c, d, e, l, gauss_points[0], m, water, f);
  const LineLoad load1 = line_load<with_tangent>(c, d, e, l, gauss_points[1], m, water, f);
  // The weight of a Gauss point, L/2, times the shape functions of the node near it and of the node far from it.
  const double near = 0.5 * L * gauss_points[1].at, far = 0.5 * L * gauss_points[0].at;
  EndLoads loads;
  loads.on = {near * load0.p + far * load1.p, far * load0.p + near * load1.p};
  if constexpr (with_tangent) {
    const double near2 = near * gauss_points[1].at, far2 = far * gauss_points[0].at, both = L / 12;
    constexpr bool varies = Water::varies;
    loads.by[0][0] = node_tangent<varies>(e, load0, load1, {-near, -far}, {near2, far2});
    loads.by[0][1] = node_tangent<varies>(e, load0, load1, {near, far}, {both, both});
    loads.by[1][0] = node_tangent<varies>(e, load0, load1, {-far, -near}, {both, both});
    loads.by[1][1] = node_tangent<varies>(e, load0, load1, {far, near}, {far2, near2});
  }
  return loads;
}

}   // namespace cablenet::elements
