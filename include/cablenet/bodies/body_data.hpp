#pragma once
#include "cablenet/base/linear_algebra.hpp"

/// Bodies as data; what acts on them is in rigid_body.hpp and body_in_water.hpp.
namespace cablenet::bodies {

using Vector4 = Eigen::Vector4d;

/// What turns: nothing (a point mass), or an attitude described in one of two ways.
enum class Rotation { none, euler, quaternion };

struct Properties {
  Rotation rotation = Rotation::none;
  Matrix3 inertia = Matrix3::Zero();              ///< about the centre of gravity, body axes [kg m^2]
  Vector3 torque = Vector3::Zero();               ///< constant, body axes [N m]
  Quaternion attitude = Quaternion::Identity();   ///< of what does not turn
  Vector3 linear_drag = Vector3::Zero();          ///< against turning, body axes [N m s], >= 0
  Vector3 quadratic_drag = Vector3::Zero();       ///< [N m s^2], >= 0
};

/// The attitude's unknowns and their first two derivatives; those that a body has not are zero.
struct RotationState {
  Vector4 y = Vector4::Zero();
  Vector4 dy = Vector4::Zero();
  Vector4 ddy = Vector4::Zero();
};

/// A body in water; the symbols are those of body_in_water.hpp.
struct BodyInWater {
  Vector3 linear = Vector3::Zero();          ///< [N s/m]
  Vector3 quadratic = Vector3::Zero();       ///< [N s^2/m^2]
  Vector3 added = Vector3::Zero();           ///< [kg]
  double radius = 0;                         ///< of the sphere that is wetted at the surface [m]
  Vector3 added_inertia = Vector3::Zero();   ///< what Properties::inertia has of the water [kg m^2]
};

/// A thing at a node: no axes.
struct PointInWater {
  double displaced = 0;   ///< rho V [kg]
  double drag = 0;        ///< 1/2 rho CdA [kg/m]
  double added = 0;       ///< [kg]
  double radius = 0;      ///< as above [m]
};

}   // namespace cablenet::bodies
