#include "cablenet/bodies/carrying.hpp"

#include <cmath>
#include <numbers>

namespace cablenet::bodies {
namespace {

/// cos(pitch) below which roll and yaw are hardly told apart: 0.6 degrees from the vertical.
constexpr double least_cosine = 0.01;

}   // namespace

void differentiate(const StageMotion& motion, const StageForces& forces, const Vector3& r, bool has_rates,
                   CarriedTangent& tangent) {
  const auto fill = [&r](const Stacked& by, RowMajor<3, 4>& columns) {
    Matrix34 all;
    Eigen::Map<Eigen::Matrix<double, 12, 1>>(all.data()).noalias() = by.lazyProduct(r);
    columns = all;
  };
  fill(motion.by_position, tangent.x);
  fill(motion.by_acceleration, tangent.a);
  if (has_rates) fill(motion.by_velocity, tangent.v);
  const Vector3 lever = forces.lever * r;
  for (int k = 0; k < tangent.unknowns; ++k) tangent.load.col(k) = forces.turn.col(k).cross(lever);
}

Vector4 attitude_forces(const StageForces& forces, const Vector3& torque) {
  return forces.own + forces.turn.transpose() * torque;
}

void add_attitude_slopes(const Properties& body, const StageForces& forces, const CarriedForces& sum,
                         const Vector3& torque, BodyBlock& block) {
  // As torque_of(), for all unknowns at once.
  const Stacked m = forces.by_lever.lazyProduct(sum.moments.transpose());
  Matrix34 by_torque;
  for (int k = 0; k < 4; ++k)
    by_torque.col(k) << m(3 * k + 1, 2) - m(3 * k + 2, 1), m(3 * k + 2, 0) - m(3 * k, 2), m(3 * k, 1) - m(3 * k + 1, 0);
  block.block<4, 4>(3, 3) +=
      forces.by_own + forces.turn.transpose() * by_torque + turn_slope(body.rotation, forces, torque);
}

void add_steadiness(const Properties& body, const StageForces& forces, double stiffness, BodyBlock& block) {
  Matrix4 held = forces.turn.transpose() * forces.turn;
  if (body.rotation == Rotation::quaternion) held = 4 / forces.y.squaredNorm() * Matrix4::Identity();
  block.block<4, 4>(3, 3) += stiffness * held;
}

/// A conserving step's lever grows without limit as the step nears half a turn.
bool is_in_domain(const Properties& body, const Start& start, const StepRule& rule, const Vector4& y) {
  if (body.rotation == Rotation::none) return true;
  if (rule.conserving) return start.y.dot(y) > 0.5 * start.y.squaredNorm();
  if (rule.dt == 0 || body.rotation != Rotation::euler) return y.allFinite();
  const Vector4 end = start.y + (y - start.y) / rule.alpha_f;
  // A step that goes further towards 90 degrees than half the way is too coarse for what happens there.
  const double way = 0.5 * std::numbers::pi - std::abs(start.y(1));
  return std::abs(end(1) - start.y(1)) < 0.5 * way + 0.02 && distance_from_singular(body.rotation, end) > least_cosine;
}

Vector3 end_velocity(const Properties& body, const Start& start, double dt, bool is_conserving, bool is_free,
                     RotationState& end) {
  if (!is_conserving || body.rotation != Rotation::quaternion) return angular_velocity(body.rotation, end);
  const Vector3 w = is_free ? end_by_momentum(body, start, dt, end.y) : end_by_turn(start, dt, end.y);
  end = rotation_state(body.rotation, attitude(body, end.y), w);
  return w;
}

}   // namespace cablenet::bodies
