#pragma once
#include "cablenet/base/linear_algebra.hpp"

/// The data of bodies.  rigid_body.hpp and body_in_water.hpp compute the forces on them.
namespace cablenet::bodies {

using Vector4 = Eigen::Vector4d;
using Matrix34 = Eigen::Matrix<double, 3, 4>;

/// A body does not turn (a point mass), or its attitude is described by roll, pitch and yaw or by a quaternion.
enum class Rotation { none, euler, quaternion };

/// The properties of a body that its rotation depends on.
struct Properties {
  Rotation rotation = Rotation::none;
  Matrix3 inertia = Matrix3::Zero();              ///< about the centre of gravity, body axes [kg m^2]
  Vector3 torque = Vector3::Zero();               ///< constant, body axes [N m]
  Quaternion attitude = Quaternion::Identity();   ///< constant attitude of a body that does not turn
  Vector3 linear_drag = Vector3::Zero();          ///< against rotation, body axes [N m s], >= 0
  Vector3 quadratic_drag = Vector3::Zero();       ///< against rotation, body axes [N m s^2], >= 0
};

/// The unknowns y of an attitude and their first two time derivatives.  Components that a body does not have are zero.
struct RotationState {
  Vector4 y = Vector4::Zero();
  Vector4 dy = Vector4::Zero();
  Vector4 ddy = Vector4::Zero();
};

/// The properties of a body that the forces of water depend on, in body axes.  body_in_water.hpp defines the symbols.
struct BodyInWater {
  Vector3 linear = Vector3::Zero();          ///< [N s/m]
  Vector3 quadratic = Vector3::Zero();       ///< [N s^2/m^2]
  Vector3 added = Vector3::Zero();           ///< [kg]
  double radius = 0;                         ///< of the sphere that stands for the body at the surface [m]
  Vector3 added_inertia = Vector3::Zero();   ///< the water's part of Properties::inertia [kg m^2]
};

/// The properties of a point in water.  They do not depend on direction.
struct PointInWater {
  double displaced = 0;   ///< rho V [kg]
  double drag = 0;        ///< 1/2 rho CdA [kg/m]
  double added = 0;       ///< [kg]
  double radius = 0;      ///< of the sphere that stands for the point at the surface [m]
};

}   // namespace cablenet::bodies
