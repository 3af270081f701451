#pragma once
#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/base/shift.hpp"
#include "cablenet/bodies/body_data.hpp"

/// A rigid body: the position X of its centre of gravity and its attitude, a quaternion q of four unknowns of which
/// none is ever singular, or the papers' roll, pitch, yaw.  A cable's end is fastened at x = X + R r.
/// Euler's equations I w' + w x I w + drag(w) = torque (body axes), drag_i = linear_i w_i + quadratic_i |w_i| w_i, are
/// weighted by the rates' map w = rates y'.  Where a step is taken `conserving` (quaternions, no drag), they are taken
/// from end to end:
///   R1 = R0 exp(dt (w0 + w1)/2),  R1 I w1 - R0 I w0 = dt torque,  |q1| = 1,
/// levers of forces (R0 + R1) r/2 times tan(a/2)/(a/2), a the angle turned, so that the kinetic energy changes by
/// exactly what forces at attachments and the torque do, and without them energy and angular momentum stay.
/// Otherwise they hold at the stage, and a gauge 4 Is q (g'' + 2 s g' + s^2 g), g = (|q|^2 - 1)/2, s = 0.1/dt or, at an
/// instant, 1/s, which moves nothing, keeps |q| near 1.
///
/// Source: Tonin & Braun, CILAMCE 2020, eqs 13-18.  End to end: after Simo & Wong, IJNME 31 (1991) 19.
/// Tests: tests/unit/rigid_body_test.cpp
namespace cablenet::bodies {

/// Beyond its position: 0, 3 or 4.
int rotation_unknowns(Rotation);

using Matrix4 = Eigen::Matrix4d;
using Matrix34 = Eigen::Matrix<double, 3, 4>;

/// The unknowns of an attitude and an angular velocity (body axes).
RotationState rotation_state(Rotation, const Quaternion& attitude, const Vector3& w);
/// Body axes to world, unit; its sign follows y continuously.
Quaternion attitude(const Properties&, const Vector4& y);
/// Body axes [rad/s].
Vector3 angular_velocity(Rotation, const RotationState&);
/// cos(pitch) where that is what may become singular, otherwise 1.
double distance_from_singular(Rotation, const Vector4& y);

/// A body at the start of a step.
struct Start {
  Vector4 y = Vector4::Zero(), dy = Vector4::Zero();
  Matrix3 R = Matrix3::Identity();
  Vector3 w = Vector3::Zero();
};
Start start_of(const Properties&, const Vector4& y, const Vector4& dy);

/// The stage y_a = y0 + alpha_f (y1 - y0) of a step; at an instant alpha_f = 1, dt = 0.
struct StepRule {
  double alpha_f = 1;
  double dt = 0;
  bool conserving = false;   ///< @pre alpha_f = 1/2, a quaternion
};

/// A map's derivatives by the unknowns, one below the other: times r it is that of the map's r, (3, 4) column-major.
using Stacked = Eigen::Matrix<double, 12, 3>;

/// An attachment r moves as X_a + position r, X_a' + velocity r, X_a'' + acceleration r, where position and velocity
/// lie between the step's two ends.
struct StageMotion {
  Matrix3 position, velocity, acceleration;
  Stacked by_position = Stacked::Zero(), by_velocity = by_position, by_acceleration = by_position;
};

/// What makes the attitude turn.
struct StageForces {
  Matrix3 lever;   ///< a force F at r turns by (lever r) x F, world frame
  Matrix34 turn;   ///< a torque T, world frame, is the generalised force turn^T T on y
  Vector4 own;     ///< inertia, gyroscopic, drag and gauge forces on y less the constant torque's
  Stacked by_lever = Stacked::Zero();
  Matrix4 by_own = Matrix4::Zero();
  Vector4 y = Vector4::Zero();   ///< of the stage
  double shift_x = 0;            ///< Shift::x
};

/// @param shift  of y_a, y_a', y_a''; none: values alone, the derivatives (by_...) stay as they are
/// @param with_velocity  StageMotion::by_velocity is of use
void evaluate(const Properties&, const Start&, const StepRule&, const RotationState& stage, const Shift* shift,
              bool with_velocity, StageMotion& motion, StageForces& forces);

/// The derivative of turn^T T, T held, by the unknowns.
Matrix4 turn_slope(Rotation, const StageForces&, const Vector3& torque);

/// w at the end of a conserving step by its kinematics: 2 W - w0, dt W being the turn from q0 to q1.
Vector3 end_by_turn(const Start&, double dt, const Vector4& y1);
/// The same by its dynamics where no forces act: I^-1 R1^T (R0 I w0 + dt (R0 + R1)/2 torque).  Differences of attitudes
/// lose digits that this has, but it would take in what rounding does to stiff cables' forces.
Vector3 end_by_momentum(const Properties&, const Start&, double dt, const Vector4& y1);

/// Sum of F r^T over forces F at attachments r; all that the attitude's equations need of them.  [N m]
using Moments = Matrix3;
/// The forces' torque sum (lever r) x F.
Vector3 torque_of(const Matrix3& lever, const Moments& moments);

}   // namespace cablenet::bodies
