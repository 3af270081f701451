#pragma once
#include "cablenet/bodies/carried_data.hpp"
#include "cablenet/bodies/rigid_body.hpp"

/// What a body's attitude does to the nodes that it carries, and what forces on these do to it.
/// Tests: tests/parallel/bodies_test.cpp
namespace cablenet::bodies {

/// The tangent of a node at r, body axes [m].
/// @param has_rates  v is of use
void differentiate(const StageMotion&, const StageForces&, const Vector3& r, bool has_rates, CarriedTangent&);

/// F and F r^T of forces F at attachments r.
struct CarriedForces {
  Vector3 force = Vector3::Zero();
  Moments moments = Moments::Zero();
};

/// The rows of the attitude: its own forces and turn^T torque.
Vector4 attitude_forces(const StageForces&, const Vector3& torque);
/// Adds the derivatives of attitude_forces() by the attitude.
/// @param torque  that of the forces
void add_attitude_slopes(const Properties&, const StageForces&, const CarriedForces&, const Vector3& torque,
                         BodyBlock&);
/// Adds a stiffness [N m] against turning.  A torque's derivative by a quaternion couples turning with the
/// quaternion's length, which therefore gets as much.
void add_steadiness(const Properties&, const StageForces&, double stiffness, BodyBlock&);

/// The step to y can be followed: a conserving one does not turn by half a turn, and Euler angles stay clear of a
/// pitch of 90 degrees.
bool is_in_domain(const Properties&, const Start&, const StepRule&, const Vector4& y);

/// The angular velocity at a step's end, body axes [rad/s].  A conserving step of a quaternion sets the end's unknowns.
/// @param is_free  nothing is attached to the body
Vector3 end_velocity(const Properties&, const Start&, double dt, bool is_conserving, bool is_free, RotationState& end);

}   // namespace cablenet::bodies
