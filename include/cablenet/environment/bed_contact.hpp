#pragma once
#include <algorithm>
#include <cmath>

#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/environment/bed.hpp"

/// Contact with a flat seabed.  Tests: tests/unit/bed_test.cpp
namespace cablenet::environment {

struct BedForce {
  Vector3 force;                    ///< [N]
  Matrix3 by_x = Matrix3::Zero();   ///< [N/m]
  Matrix3 by_v = Matrix3::Zero();   ///< [N s/m]
};

/// P, P' and P''.
struct Indentation {
  double P, slope, curvature;
};
inline Indentation indentation(double p, double smoothing) {
  if (p <= -smoothing) return {0, 0, 0};
  if (p >= smoothing) return {p, 1, 0};
  const double s = p + smoothing, slope = 0.5 * s / smoothing;
  return {0.5 * slope * s, slope, 0.5 / smoothing};
}

/// The mean of P between two depths, from a difference of numbers that are not nearly equal.
inline double mean_indentation(double p0, double p1, double smoothing) {
  const double low = std::min(p0, p1), high = std::max(p0, p1);
  const double s0 = std::clamp(low, -smoothing, smoothing) + smoothing;
  const double s1 = std::clamp(high, -smoothing, smoothing) + smoothing;
  const double below0 = std::max(low, smoothing), below1 = std::max(high, smoothing);
  const double joint = (s1 - s0) * (s0 * s0 + s0 * s1 + s1 * s1) / (12 * smoothing);
  return (joint + 0.5 * (below1 - below0) * (below0 + below1)) / (high - low);
}

/// N over area and its derivatives by z and v_z.
struct BedPressure {
  double N, by_z, by_v;
};
inline BedPressure bed_pressure(const Bed& bed, double smoothing, double p, double rise, double dt) {
  // On a path as short as this P is linear.
  constexpr double shortest = 1e-6;
  if (std::abs(rise) * dt <= shortest * (smoothing + std::abs(p))) {
    const Indentation at = indentation(p, smoothing);
    return {bed.stiffness * at.P - bed.damping * at.slope * rise,
            -bed.stiffness * at.slope + bed.damping * at.curvature * rise, -bed.damping * at.slope};
  }
  const double p0 = p + 0.5 * dt * rise, p1 = p - 0.5 * dt * rise;
  const Indentation start = indentation(p0, smoothing), end = indentation(p1, smoothing);
  const double mean = mean_indentation(p0, p1, smoothing), rate = bed.damping / dt;
  const double by_p0 = bed.stiffness * (mean - start.P) / (p1 - p0) - rate * start.slope;
  const double by_p1 = bed.stiffness * (end.P - mean) / (p1 - p0) + rate * end.slope;
  return {bed.stiffness * mean + rate * (end.P - start.P), -by_p0 - by_p1, 0.5 * dt * (by_p0 - by_p1)};
}

/// On a node at x moving at v: with the depth p = level - z, N = area (stiffness P(p) + damping dP(p)/dt) upwards and
/// friction -mu max(N, 0) v_t/sqrt(v_t^2 + v_s^2) along the bed, v_t the horizontal velocity.  P(p) is p below the bed
/// and 0 above, joined by the parabola (p + smoothing)^2/(4 smoothing) over |p| < smoothing.
/// In a step N is the mean over the node's path x + tau v, |tau| <= dt/2.  What stops a node that comes down then grows
/// from zero with the share of the step that it is in contact; all of damping at once is more than Newton's method
/// gets over.
/// @param area  diameter x length of cable that the node stands for [m^2]   @param smoothing [m], > 0
/// @param dt    of the step; 0: at an instant [s]
/// Limits: damping makes N pull where a node leaves the bed fast.
template <bool with_tangent>
BedForce bed_force(const Bed& bed, double area, double smoothing, double dt, const Vector3& x, const Vector3& v) {
  BedForce result{Vector3::Zero()};
  const double p = bed.level - x.z();
  if (p + 0.5 * dt * std::abs(v.z()) <= -smoothing) return result;
  const BedPressure pressure = bed_pressure(bed, smoothing, p, v.z(), dt);
  const double N = area * pressure.N, N_by_z = area * pressure.by_z, N_by_v = area * pressure.by_v;
  result.force.z() = N;
  if constexpr (with_tangent) {
    result.by_x(2, 2) = N_by_z;
    result.by_v(2, 2) = N_by_v;
  }
  if (bed.friction == 0 || N <= 0) return result;
  const Vector3 along(v.x(), v.y(), 0);
  const double speed = std::sqrt(along.squaredNorm() + bed.friction_velocity * bed.friction_velocity);
  const Vector3 per_N = -bed.friction / speed * along;
  result.force += N * per_N;
  if constexpr (with_tangent) {
    result.by_x.col(2) += N_by_z * per_N;
    result.by_v.col(2) += N_by_v * per_N;
    result.by_v.topLeftCorner<2, 2>().diagonal().array() -= bed.friction * N / speed;
    result.by_v -= N / (speed * speed) * per_N * along.transpose();
  }
  return result;
}

}   // namespace cablenet::environment
