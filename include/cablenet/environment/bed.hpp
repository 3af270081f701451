#pragma once
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
/// friction -mu max(N, 0) v_t/sqrt(v_t^2 + v_s^2) along the bed.  P(p) is p below the bed and 0 above, joined by a
/// parabola over |p| < smoothing.
/// @param area  diameter x length of cable that the node stands for [m^2]   @param smoothing [m], > 0
template <bool with_tangent>
BedForce bed_force(const Bed&, double area, double smoothing, const Vector3& x, const Vector3& v);

}   // namespace cablenet::environment
