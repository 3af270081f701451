#pragma once
#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/bodies/body_data.hpp"
#include "cablenet/environment/fluid.hpp"

/// What water does to a rigid body's centre of gravity and to a point: in body axes, with u the water's velocity there
/// less the body's, w its acceleration less the body's,
///   F_i = wet [ linear_i u_i + quadratic_i |u_i| u_i + added_i w_i ],  i = x, y, z.
/// A point's drag 1/2 rho CdA |u| u and added mass have no axes.  Buoyancy rho V (g ez + a_water) is a force of its
/// own, at the centre of buoyancy.  wet is the wetted fraction of a sphere, 1 without a surface.  Drag against turning
/// is bodies::Properties' affair, added inertia is in its inertia.
/// Limits: what added mass that differs between the axes does as the body turns or moves slantwise (Kirchhoff's
/// products of rates, Munk's moment) is left out.
/// Source: Faltinsen, Sea Loads on Ships and Offshore Structures (1990), ch. 3, 7.
/// Tests: tests/unit/body_in_water_test.cpp
namespace cablenet::bodies {

struct PointMotion {
  Vector3 x, v, a;
};

/// A load and its derivatives by the motion.
struct PointLoad {
  Vector3 force;   ///< world axes [N]
  Matrix3 by_x = Matrix3::Zero(), by_v = Matrix3::Zero(), by_a = Matrix3::Zero();
};
/// A body's also depends on its attitude R.
struct BodyLoad : PointLoad {
  Vector3 inner = Vector3::Zero();                          ///< body axes: force = R inner
  Matrix3 by_u = Matrix3::Zero(), by_w = Matrix3::Zero();   ///< of inner, by R^T u and R^T w
  Vector3 u = Vector3::Zero(), w = Vector3::Zero();         ///< world axes
  /// The force's derivative in the direction dR of R.
  Vector3 by_rotation(const Matrix3& R, const Matrix3& dR) const {
    return dR * inner + R * (by_u * (dR.transpose() * u) + by_w * (dR.transpose() * w));
  }
};

/// @param gravity [m/s^2]
PointLoad point_load(const PointInWater&, const environment::Fluid&, double t, double gravity, const PointMotion&);
/// @param R  body axes to world
BodyLoad body_load(const BodyInWater&, const environment::Fluid&, double t, const Matrix3& R, const PointMotion&);

}   // namespace cablenet::bodies
