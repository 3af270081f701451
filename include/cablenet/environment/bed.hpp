#pragma once
#include <cmath>

#include "cablenet/base/linear_algebra.hpp"

/// Contact with a flat seabed.  Tests: tests/unit/bed_test.cpp
namespace cablenet::environment {

struct Bed {
  double level = 0;                  ///< z [m]
  double stiffness = 0;              ///< [Pa/m], > 0
  double damping = 0;                ///< [Pa s/m], >= 0
  double friction = 0;               ///< Coulomb's coefficient, >= 0
  double friction_velocity = 0.01;   ///< at which friction is 1/sqrt(2) of Coulomb's [m/s], > 0
};

struct BedForce {
  Vector3 force;                    ///< [N]
  Matrix3 by_x = Matrix3::Zero();   ///< [N/m]
  Matrix3 by_v = Matrix3::Zero();   ///< [N s/m]
};

/// On a node at x moving at v: with the depth p = level - z, N = area (stiffness P(p) - damping P'(p) v_z) upwards and
/// friction -mu max(N, 0) v_t/sqrt(v_t^2 + v_s^2) along the bed, v_t the horizontal velocity.  P(p) is p below the bed
/// and 0 above, joined by the parabola (p + smoothing)^2/(4 smoothing) over |p| < smoothing.
/// @param area  diameter x length of cable that the node stands for [m^2]   @param smoothing [m], > 0
/// Limits: damping makes N pull where a node leaves the bed faster than stiffness P/(damping P').
template <bool with_tangent>
BedForce bed_force(const Bed& bed, double area, double smoothing, const Vector3& x, const Vector3& v) {
  BedForce result{Vector3::Zero()};
  const double p = bed.level - x.z();
  if (p <= -smoothing) return result;
  const bool joined = p < smoothing;
  const double s = p + smoothing, curvature = joined ? 0.5 / smoothing : 0;
  const double slope = joined ? curvature * s : 1, P = joined ? 0.5 * slope * s : p;
  const double N = area * (bed.stiffness * P - bed.damping * slope * v.z());
  const double N_by_z = -area * (bed.stiffness * slope - bed.damping * curvature * v.z());
  const double N_by_v = -area * bed.damping * slope;
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
