#pragma once
#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/base/shift.hpp"
#include "cablenet/bodies/body_data.hpp"

/// A rigid body has the position X of its centre of gravity and an attitude R.  Its attitude is described by a
/// quaternion q, four unknowns that have no singular attitude, or by the papers' roll, pitch and yaw.  A cable's end
/// that is attached at r (body axes) lies at x = X + R r.
/// Euler's equations in body axes are I w' + w x I w + drag(w) = torque, drag_i = linear_i w_i + quadratic_i |w_i| w_i.
/// The map w = rates y' gives w from y.  The equations for the unknowns y are rates^T times Euler's.
/// A `conserving` step (quaternions, no drag) takes them from the step's start 0 to its end 1, in world axes:
///   R1 = R0 exp(dt (w0 + w1)/2),  R1 I w1 - R0 I w0 = dt torque,  |q1| = 1.
/// The lever of a force at r is (R0 + R1) r/2 times tan(a/2)/(a/2), where a is the angle turned.  The kinetic energy
/// then changes by exactly the work of the torque and of forces at attachments.  Without torque and forces, energy and
/// angular momentum are conserved.
/// Any other step solves Euler's equations at its stage.  There a gauge force 4 Is q (g'' + 2 s g' + s^2 g) on q keeps
/// |q| near 1 and does not move the body: g = (|q|^2 - 1)/2, Is = trace(I)/3, s = 0.1/dt (at an instant s = 1 1/s).
///
/// Source: Tonin & Braun, CILAMCE 2020, eqs 13-18.  Conserving steps: after Simo & Wong, IJNME 31 (1991) 19.
/// Tests: tests/unit/rigid_body_test.cpp
namespace cablenet::bodies {

/// The number of a body's unknowns beyond its position: 0, 3 or 4.
int rotation_unknowns(Rotation);

using Matrix4 = Eigen::Matrix4d;

/// The unknowns that describe an attitude and an angular velocity w (body axes [rad/s]).
RotationState rotation_state(Rotation, const Quaternion& attitude, const Vector3& w);
/// The attitude as a unit quaternion, body axes to world.  Its sign follows y continuously.
Quaternion attitude(const Properties&, const Vector4& y);
/// The angular velocity in body axes.  [rad/s]
Vector3 angular_velocity(Rotation, const RotationState&);
/// The distance of y from a singular attitude: cos(pitch) for Euler angles, and 1 for rotations that have none.
double distance_from_singular(Rotation, const Vector4& y);

/// The attitude and its motion at the start of a step.
struct Start {
  Vector4 y = Vector4::Zero(), dy = Vector4::Zero();
  Matrix3 R = Matrix3::Identity();
  Vector3 w = Vector3::Zero();
};
Start start_of(const Properties&, const Vector4& y, const Vector4& dy);

/// The equations of a step hold at its stage y_a = y0 + alpha_f (y1 - y0).  At an instant alpha_f = 1 and dt = 0.
struct StepRule {
  double alpha_f = 1;
  double dt = 0;
  bool conserving = false;   ///< @pre alpha_f = 1/2, a quaternion
};

/// The derivatives of a 3x3 map by the unknowns, one below the other.  Their product with r has 12 entries: the (3, 4)
/// derivatives of (map r) by the unknowns, column-major.
using Stacked = Eigen::Matrix<double, 12, 3>;

/// Position, velocity and acceleration of an attachment r at the stage are X_a + position r, X_a' + velocity r and
/// X_a'' + acceleration r.  The maps `position` and `velocity` lie between their values at the step's start and end.
struct StageMotion {
  Matrix3 position, velocity, acceleration;
  Stacked by_position = Stacked::Zero(), by_velocity = by_position, by_acceleration = by_position;
};

/// The forces on the attitude's unknowns y.
struct StageForces {
  Matrix3 lever;   ///< a force F at r has the torque (lever r) x F, world axes
  Matrix34 turn;   ///< a torque T, world axes, is the generalised force turn^T T on y
  Vector4 own;     ///< inertial, gyroscopic, drag and gauge forces on y, less the constant torque's force on y
  Stacked by_lever = Stacked::Zero();
  Matrix4 by_own = Matrix4::Zero();
  Vector4 y = Vector4::Zero();   ///< y_a, the unknowns at the stage
  double shift_x = 0;            ///< Shift::x
};

/// Evaluates a body's rotation at the stage of a step.
/// @param shift  derivatives of y_a, y_a', y_a'' by the unknowns; with nullptr the derivatives by_... are not set
/// @param with_velocity  whether StageMotion::by_velocity is needed
void evaluate(const Properties&, const Start&, const StepRule&, const RotationState& stage, const Shift* shift,
              bool with_velocity, StageMotion& motion, StageForces& forces);

/// The derivative of turn^T T by the unknowns, where T is constant.
Matrix4 turn_slope(Rotation, const StageForces&, const Vector3& torque);

/// w at the end of a conserving step, from kinematics: 2 W - w0, where the rotation vector dt W turns q0 into q1.
Vector3 end_by_turn(const Start&, double dt, const Vector4& y1);
/// w at the end of a conserving step in which no forces act on attachments, from dynamics:
/// I^-1 R1^T (R0 I w0 + dt (R0 + R1)/2 torque).  It keeps the digits that end_by_turn loses in a difference of
/// attitudes.  With forces it would not do, because it would take in the rounding of stiff cables' forces.
Vector3 end_by_momentum(const Properties&, const Start&, double dt, const Vector4& y1);

/// The sum of F r^T over forces F at attachments r.  The attitude's equations need no more of the forces.  [N m]
using Moments = Matrix3;
/// The torque of the forces: the sum of (lever r) x F.
Vector3 torque_of(const Matrix3& lever, const Moments& moments);

}   // namespace cablenet::bodies
