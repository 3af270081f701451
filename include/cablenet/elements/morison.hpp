#pragma once
#include <cmath>

#include "cablenet/elements/cable_in_water.hpp"
#include "cablenet/environment/water.hpp"

/// Morison's load per unstretched length of a fully wet cable; cable_in_water_loads.hpp inlines it.
/// Source and tests: see cable_in_water.hpp.
namespace cablenet::elements {

/// A derivative of the line load on a cable along e has the form a I + e q^T + c M, where M is LineLoad::M.
struct LineSlope {
  double a;
  Vector3 q;
  double c;
};

/// A line load p [N/m] and, where a tangent is wanted, its derivatives by the unknowns of the chord and of the point.
/// A chord's unknowns are the difference of its nodes' unknowns.  A point's unknowns are interpolated between the
/// nodes.
struct LineLoad {
  Vector3 p;
  Matrix3 M;         ///< un un^T/|un| [m/s]
  LineSlope chord;   ///< derivative by the chord, through its direction e
  LineSlope point;   ///< derivative by the point, through its velocity and acceleration
  // Only water that varies sets these two.
  Matrix3 by_place;   ///< derivative by the point, through the water's motion at its place
  Vector3 by_rise;    ///< derivative by the chord's z, through the wetted fraction
};

/// The relative velocity u and acceleration w, divided into ut, wt along the cable and un, wn across it.
struct CrossFlow {
  double ut, wt, speed;   ///< speed = |un|
  Vector3 un, wn;
  CrossFlow(const Vector3& e, const Vector3& u, const Vector3& w)
      : ut(e.dot(u)), wt(e.dot(w)), un(u - ut * e), wn(w - wt * e) {
    speed = un.norm();
  }
  Vector3 load(const CableInWater& c, const Vector3& e) const {
    return c.normal_drag * speed * un + c.tangential_drag * std::abs(ut) * ut * e + c.added * wn;
  }
  Matrix3 M() const {
    const double inverse = speed > 0 ? 1 / speed : 0;
    return (inverse * un).lazyProduct(un.transpose());
  }
  /// scale times the load's derivative by e, where e changes direction but not length.
  LineSlope by_axis(const CableInWater& c, const Vector3& e, double scale) const {
    const double along = c.tangential_drag * std::abs(ut), across = c.normal_drag * speed;
    const double turning = scale * ((along - across) * ut - c.added * wt);
    return {turning, scale * ((2 * along - across) * un - c.added * wn) - turning * e, -scale * c.normal_drag * ut};
  }
  /// drag times the load's derivative by u, plus added times its derivative by w.
  LineSlope by_flow(const CableInWater& c, const Vector3& e, double drag, double added) const {
    const double across = drag * c.normal_drag * speed + added * c.added;
    return {across, (2 * drag * c.tangential_drag * std::abs(ut) - across) * e, drag * c.normal_drag};
  }
};

inline LineSlope sum(double v, const LineSlope& chord, double w, const LineSlope& point) {
  return {v * chord.a + w * point.a, v * chord.q + w * point.q, v * chord.c + w * point.c};
}

/// The load on a dry cable.
inline LineLoad no_line_load() {
  const Vector3 zero = Vector3::Zero();
  const LineSlope none{0, zero, 0};
  return {zero, Matrix3::Zero(), none, none, Matrix3::Zero(), zero};
}

template <bool with_tangent>
LineLoad wet_line_load(const CableInWater& c, const Vector3& e, double l, const CrossFlow& flow, const Shift& f) {
  LineLoad load;
  load.p = flow.load(c, e);
  if constexpr (with_tangent) {
    load.M = flow.M();
    load.chord = flow.by_axis(c, e, f.x / l);
    load.point = flow.by_flow(c, e, -f.v, -f.a);
  }
  return load;
}

/// f times the derivative, by the place, of the load that the flow exerts.
inline Matrix3 by_place(const CableInWater& c, const Vector3& e, const CrossFlow& flow, const Matrix3& M,
                        const environment::WaterMotion& water, double f) {
  const LineSlope by_u = flow.by_flow(c, e, f, 0);
  Matrix3 drag = by_u.c * M + e.lazyProduct(by_u.q.transpose());
  drag.diagonal().array() += by_u.a;
  const Vector3 along = f * c.added * (water.acceleration_slope.transpose() * e);
  return drag.lazyProduct(water.velocity_slope) + f * (c.displaced + c.added) * water.acceleration_slope -
         e.lazyProduct(along.transpose());
}

}   // namespace cablenet::elements
