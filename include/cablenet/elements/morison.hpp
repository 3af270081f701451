#pragma once
#include <cmath>

#include "cablenet/elements/cable_in_water.hpp"

/// Morison's load per length of a wet cable, inlined by cable_in_water_loads.hpp.  Source and tests as in
/// cable_in_water.hpp.
namespace cablenet::elements {

/// a I + b e e^T + c n n^T.
inline Matrix3 diagonal_and_axes(double a, double b, const Vector3& e, double c, const Vector3& n) {
  Matrix3 m = b * e * e.transpose();
  m += c * n * n.transpose();
  m.diagonal().array() += a;
  return m;
}

/// A line load [N/m] and its derivatives by the chord and by the unknowns of the point on it.
struct LineLoad {
  Vector3 p;
  Matrix3 by_chord, by_point;
};

/// Drag and added mass on a wet cable along e.
struct CrossFlow {
  double ut, wt, speed;   ///< along the cable; |un|
  Vector3 un, wn;
  CrossFlow(const Vector3& e, const Vector3& u, const Vector3& w)
      : ut(e.dot(u)), wt(e.dot(w)), un(u - ut * e), wn(w - wt * e) {
    speed = un.norm();
  }
  Vector3 load(const CableInWater& c, const Vector3& e) const {
    return c.normal_drag * speed * un + c.tangential_drag * std::abs(ut) * ut * e + c.added * wn;
  }
  Vector3 direction() const { return speed > 0 ? Vector3(1 / speed * un) : Vector3(Vector3::Zero()); }
  /// By e, turning only.
  Matrix3 by_axis(const CableInWater& c, const Vector3& e) const {
    const double along = c.tangential_drag * std::abs(ut), across = c.normal_drag * speed;
    const double turning = (along - across) * ut - c.added * wt;
    Matrix3 m = diagonal_and_axes(turning, -turning, e, -across * ut, direction());
    m += e * ((2 * along - across) * un - c.added * wn).transpose();
    return m;
  }
  /// drag times that by u + added times that by w.
  Matrix3 by_flow(const CableInWater& c, const Vector3& e, double drag, double added) const {
    const double across = drag * c.normal_drag * speed, along = 2 * drag * c.tangential_drag * std::abs(ut);
    const double normal = across + added * c.added;
    return diagonal_and_axes(normal, along - normal, e, across, direction());
  }
};

/// An element's chord.
struct Chordwise {
  Vector3 e;
  double l;   ///< [m]
  double dz;
};

template <bool with_tangent>
LineLoad wet_line_load(const CableInWater& c, const Chordwise& chord, const Vector3& v, const Vector3& a,
                       const UniformWater& water, const Follow& f) {
  const CrossFlow flow(chord.e, water.velocity - v, -a);
  LineLoad load;
  load.p = flow.load(c, chord.e);
  load.p.z() += c.displaced * water.gravity;
  if constexpr (with_tangent) {
    load.by_chord = f.x / chord.l * flow.by_axis(c, chord.e);
    load.by_point = flow.by_flow(c, chord.e, -f.v, -f.a);
  }
  return load;
}

template <bool with_tangent>
LineLoad wet_line_load(const CableInWater& c, const Chordwise& chord, const Vector3& v, const Vector3& a,
                       const environment::WaterMotion& water, double gravity, const Follow& f) {
  const CrossFlow flow(chord.e, water.velocity - v, water.acceleration - a);
  LineLoad load;
  load.p = flow.load(c, chord.e) + c.displaced * water.acceleration;
  load.p.z() += c.displaced * gravity;
  if constexpr (with_tangent) {
    load.by_chord = f.x / chord.l * flow.by_axis(c, chord.e);
    load.by_point = flow.by_flow(c, chord.e, -f.v, -f.a) + f.x * c.displaced * water.acceleration_slope;
    load.by_point += flow.by_flow(c, chord.e, f.x, 0) * water.velocity_slope;
    load.by_point += flow.by_flow(c, chord.e, 0, f.x) * water.acceleration_slope;
  }
  return load;
}

}   // namespace cablenet::elements
