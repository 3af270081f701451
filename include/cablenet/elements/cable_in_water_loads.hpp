#pragma once
#include <cmath>
#include <numbers>

#include "cablenet/elements/morison.hpp"

/// The loads of cable_in_water.hpp in the form that the loop over elements inlines; nothing is evaluated for what the
/// water has not.  Source and tests as there.
namespace cablenet::elements {

/// Where one of the two Gauss points lies: N1 = 1 - at, N2 = at.
struct GaussPoint {
  double at;
  double middle;   ///< of the half element around it
};
constexpr double gauss_offset = 0.5 * std::numbers::inv_sqrt3;
constexpr std::array<GaussPoint, 2> gauss_points{{{0.5 - gauss_offset, 0.25}, {0.5 + gauss_offset, 0.75}}};

inline Vector3 between(const std::array<Vector3, 2>& ends, double at) { return (1 - at) * ends[0] + at * ends[1]; }

/// How much of the half element around a Gauss point at x is wet, and the derivatives.
struct HalfWetness {
  double fraction;
  double by_rise = 0;                   ///< by the chord's z
  Vector3 by_point = Vector3::Zero();   ///< by x
};

inline HalfWetness half_wetness(const environment::Fluid& fluid, double t, double diameter, const Chordwise& chord,
                                const GaussPoint& gauss, const Vector3& x) {
  const double to_middle = gauss.middle - gauss.at, extent = 0.5 * std::abs(chord.dz);
  const double z = x.z() + to_middle * chord.dz, still = *fluid.surface - z;
  if (std::abs(still) >= fluid.reach() + 0.5 * (extent + diameter)) return {still > 0 ? 1.0 : 0.0};
  const environment::SurfaceHeight surface = environment::surface_height(fluid, x, t);
  const environment::Wetness wet = environment::piece_wetness(surface.z - z, extent, diameter);
  return {wet.fraction, std::copysign(0.5 * wet.by_extent, chord.dz) - to_middle * wet.by_depth,
          wet.by_depth * (surface.slope - Vector3::UnitZ())};
}

template <bool with_tangent, class Water>
LineLoad line_load(const CableInWater& c, const Chordwise& chord, const GaussPoint& gauss, const EndMotion& m,
                   const Water& water, const Follow& f) {
  const Vector3 v = between(m.v, gauss.at), a = between(m.a, gauss.at);
  if constexpr (!Water::varies) {
    return wet_line_load<with_tangent>(c, chord, v, a, water, f);
  } else {
    const Vector3 x = between(m.x, gauss.at);
    HalfWetness wet{1};
    if constexpr (Water::has_surface) wet = half_wetness(water.fluid, water.t, c.diameter, chord, gauss, x);
    if (wet.fraction == 0) return {Vector3::Zero(), Matrix3::Zero(), Matrix3::Zero()};
    const environment::WaterMotion flow = environment::water_motion(water.fluid, x, water.t);
    LineLoad load = wet_line_load<with_tangent>(c, chord, v, a, flow, water.gravity, f);
    if (!Water::has_surface || (wet.fraction == 1 && wet.by_rise == 0)) return load;
    if constexpr (with_tangent) {
      load.by_chord *= wet.fraction;
      load.by_chord.col(2) += f.x * wet.by_rise * load.p;
      load.by_point = wet.fraction * load.by_point + f.x * load.p * wet.by_point.transpose();
    }
    load.p *= wet.fraction;
    return load;
  }
}

template <bool with_tangent, class Water>
EndLoads water_loads(const CableInWater& c, double L, const EndMotion& m, const Water& water, const Follow& f) {
  const Vector3 d = m.x[1] - m.x[0];
  const double l = d.norm();
  const Chordwise chord{1 / l * d, l, d.z()};
  const LineLoad first = line_load<with_tangent>(c, chord, gauss_points[0], m, water, f);
  const LineLoad second = line_load<with_tangent>(c, chord, gauss_points[1], m, water, f);
  // N is near or far from the Gauss point; each has half the element's length.
  const double near = 0.5 * L * gauss_points[1].at, far = 0.5 * L * gauss_points[0].at;
  EndLoads loads;
  loads.on = {near * first.p + far * second.p, far * first.p + near * second.p};
  if constexpr (with_tangent) {
    const Matrix3 chord1 = near * first.by_chord + far * second.by_chord;
    const Matrix3 chord2 = far * first.by_chord + near * second.by_chord;
    const Matrix3 across = L / 12 * (first.by_point + second.by_point);
    const double near_near = near * gauss_points[1].at, far_far = far * gauss_points[0].at;
    loads.by[0] = {near_near * first.by_point + far_far * second.by_point - chord1, across + chord1};
    loads.by[1] = {across - chord2, far_far * first.by_point + near_near * second.by_point + chord2};
  }
  return loads;
}

}   // namespace cablenet::elements
