#pragma once
#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/bodies/body_data.hpp"
#include "cablenet/environment/fluid.hpp"

/// The forces of water on a rigid body and on a point.
/// Let u be the water's velocity at the body's centre of gravity less the body's velocity there, and w the water's
/// acceleration there less the body's.  The force on the centre of gravity is, in body axes,
///   F_i = wet [ linear_i u_i + quadratic_i |u_i| u_i + added_i w_i ],  i = x, y, z.
/// wet is the wetted fraction of a sphere; without a surface wet = 1.
/// The force on a point is wet [ 1/2 rho CdA |u| u + added w + rho V (g ez + a_water) ].  The last term is buoyancy.
/// A body's buoyancy acts as the force on such a point, which lies at the centre of buoyancy.
/// Drag against rotation is part of Euler's equations in rigid_body.hpp.  Added inertia is part of Properties::inertia.
/// Limits: added mass that differs between the axes would give further forces as the body turns (Kirchhoff's products
/// of rates), and a moment as the body moves obliquely to its axes (Munk's moment).  Both are left out.
/// Source: Faltinsen, Sea Loads on Ships and Offshore Structures (1990), ch. 3, 7.
/// Tests: tests/unit/body_in_water_test.cpp
namespace cablenet::bodies {

/// Position, velocity and acceleration in world axes.
struct PointMotion {
  Vector3 x, v, a;
};

/// A load and its derivatives by position, velocity and acceleration.
struct PointLoad {
  Vector3 force;   ///< world axes [N]
  Matrix3 by_x = Matrix3::Zero(), by_v = Matrix3::Zero(), by_a = Matrix3::Zero();
};
/// The load on a body also depends on its attitude R.
struct BodyLoad : PointLoad {
  Vector3 inner = Vector3::Zero();                          ///< the force in body axes: force = R inner
  Matrix3 by_u = Matrix3::Zero(), by_w = Matrix3::Zero();   ///< derivatives of inner by R^T u and R^T w
  Vector3 u = Vector3::Zero(), w = Vector3::Zero();         ///< world axes
  /// The derivative of the force when R changes by dR.
  Vector3 by_rotation(const Matrix3& R, const Matrix3& dR) const {
    return dR * inner + R * (by_u * (dR.transpose() * u) + by_w * (dR.transpose() * w));
  }
};

/// @param gravity [m/s^2]
PointLoad point_load(const PointInWater&, const environment::Fluid&, double t, double gravity, const PointMotion&);
/// @param R  body axes to world
BodyLoad body_load(const BodyInWater&, const environment::Fluid&, double t, const Matrix3& R, const PointMotion&);

/// What the water's drag takes from a turning with w, body axes.  [W]
double turning_drag_power(const Properties&, const Vector3& w);

}   // namespace cablenet::bodies
