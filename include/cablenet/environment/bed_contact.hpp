#pragma once
#include <algorithm>
#include <cmath>

#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/environment/bed.hpp"
#include "cablenet/environment/bed_friction.hpp"

/// Contact with a flat seabed.  Tests: tests/unit/bed_test.cpp
namespace cablenet::environment {

/// The bed's force on a node, and its derivatives by the node's position and velocity.
struct BedForce {
  Vector3 force;                    ///< [N]
  Matrix3 by_x = Matrix3::Zero();   ///< [N/m]
  Matrix3 by_v = Matrix3::Zero();   ///< [N s/m]
};

/// The indentation P(p) of bed_force [m] and its derivatives P' [1] and P'' [1/m].
struct Indentation {
  double P, slope, curvature;
};
inline Indentation indentation(double p, double smoothing) {
  if (p <= -smoothing) return {0, 0, 0};
  if (p >= smoothing) return {p, 1, 0};
  const double s = p + smoothing, slope = 0.5 * s / smoothing;
  return {0.5 * slope * s, slope, 0.5 / smoothing};
}

/// The integral of P from where contact sets in.  [m^2]
inline double indentation_integral(double p, double smoothing) {
  if (p <= -smoothing) return 0;
  const double s = std::min(p, smoothing) + smoothing, joint = s * s * s / (12 * smoothing);
  return p < smoothing ? joint : joint + 0.5 * (p - smoothing) * (p + smoothing);
}

/// The mean of P between two different depths.  The difference of P's antiderivatives is factored: subtracting their
/// values would cancel digits where the depths are close.
inline double mean_indentation(double p0, double p1, double smoothing) {
  const double low = std::min(p0, p1), high = std::max(p0, p1);
  const double s0 = std::clamp(low, -smoothing, smoothing) + smoothing;
  const double s1 = std::clamp(high, -smoothing, smoothing) + smoothing;
  const double below0 = std::max(low, smoothing), below1 = std::max(high, smoothing);
  const double joint = (s1 - s0) * (s0 * s0 + s0 * s1 + s1 * s1) / (12 * smoothing);
  return (joint + 0.5 * (below1 - below0) * (below0 + below1)) / (high - low);
}

/// The pressure N/area of bed_force [Pa], and its derivatives by z and v_z.
struct BedPressure {
  double N, by_z, by_v;
};
inline BedPressure bed_pressure(const Bed& bed, double smoothing, double p, double rise, double dt) {
  // On a path shorter than this part of smoothing + |p|, P is linear to rounding, and its mean is P at the middle.
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

/// The bed's force on a node at x that moves at v.  The node lies p = level - z below the bed.  The force upwards is
///   N = area (stiffness P(p) + damping dP(p)/dt)
/// The indentation P is p where p >= smoothing and 0 where p <= -smoothing.  Between the two it is the parabola
/// (p + smoothing)^2/(4 smoothing), so that P' is continuous.
/// In a step of length dt, N is the mean over the node's path x + tau v, |tau| <= dt/2.  The force that stops a falling
/// node thus grows from zero with the part of the step in which the node is in contact.  Without the mean, damping
/// would set in at its full size, and Newton's method would not get over that jump.
/// @param area       of the cable that the node stands for: diameter x length [m^2]
/// @param smoothing  half the range of depths over which contact sets in [m], > 0
/// @param dt         length of the step [s]; 0 gives N at an instant
/// @param friction   a law of bed_friction.hpp
/// Limits: where a node leaves the bed fast, damping exceeds stiffness and N pulls the node down.
template <bool with_tangent, class Friction>
BedForce bed_force(const Bed& bed, double area, double smoothing, double dt, const Vector3& x, const Vector3& v,
                   const Friction& friction) {
  BedForce result{Vector3::Zero()};
  const double p = bed.level - x.z();
  const bool touches = p + 0.5 * dt * std::abs(v.z()) > -smoothing;
  const BedPressure pressure = touches ? bed_pressure(bed, smoothing, p, v.z(), dt) : BedPressure{0, 0, 0};
  const double N = area * pressure.N, N_by_z = area * pressure.by_z, N_by_v = area * pressure.by_v;
  result.force.z() = N;
  if constexpr (with_tangent) {
    result.by_x(2, 2) = N_by_z;
    result.by_v(2, 2) = N_by_v;
  }
  if constexpr (Friction::acts) {
    const FrictionForce rub = friction.template at<with_tangent>(N, x, v);
    result.force += rub.force;
    if constexpr (with_tangent) {
      result.by_x += rub.by_x;
      result.by_v += rub.by_v;
      result.by_x.col(2) += N_by_z * rub.by_N;
      result.by_v.col(2) += N_by_v * rub.by_N;
    }
  }
  return result;
}

}   // namespace cablenet::environment
