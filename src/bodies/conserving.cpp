#include "conserving.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <utility>

#include "cablenet/bodies/rotation.hpp"

namespace cablenet::bodies {
namespace {

/// A function of u, and its derivative by u.
struct Slope {
  double value, by;
};

/// 4 atan(x/4)/x as a function of u = x^2.  The series is exact to rounding where it is used.
Slope arc_by_tangent(double u) {
  const double z = u / 16;
  if (z < 0.01) {
    double sum = 0, slope = 0;
    for (int k = 8; k >= 0; --k) {
      slope = -sum - z * slope;
      sum = 1.0 / (2 * k + 1) - z * sum;
    }
    return {sum, slope / 16};
  }
  const double root = std::sqrt(z), arc = std::atan(root) / root;
  return {arc, (1 / (1 + z) - arc) / (2 * u)};
}

/// The turn of a conserving step, R1 = R0 exp(dt W).  The middle (q0 + q1)/2 and the rate (q1 - q0)/dt give an angular
/// velocity w that is longer than W: w = 4 tan(dt |W|/4)/(dt |W|) W.  A force on the lever (R0 + R1) r/2 times `lever`
/// does the same work as at r.
struct MeanTurn {
  Matrix34 rates;   ///< at the middle
  Vector3 w;
  double u;      ///< dt^2 |w|^2
  Slope arc;     ///< W = arc w
  Slope lever;   ///< tan(dt |W|/2)/(dt |W|/2)
};

MeanTurn mean_turn(double dt, const Vector4& middle, const Vector4& rate) {
  MeanTurn turn;
  turn.rates = QuaternionRotation::rates<double>(middle);
  turn.w = turn.rates * rate;
  turn.u = dt * dt * turn.w.squaredNorm();
  turn.arc = arc_by_tangent(turn.u);
  const double rest = 1 - turn.u / 16, lever = 1 / (rest * turn.arc.value);
  turn.lever = {lever, lever * (1 / (16 * rest) - turn.arc.by / turn.arc.value)};
  return turn;
}

/// Half of dR/dq_k = M - own R, where M = 1/|q|^2 d(|q|^2 R)/dq_k.
/// @param by_square  2/|q|^2
template <int k>
Matrix3 half_slope(const Vector4& q, double by_square, const Matrix3& R) {
  const double w = by_square * q(0), x = by_square * q(1), y = by_square * q(2), z = by_square * q(3);
  const double own = by_square * q(k);
  Matrix3 M;
  if (k == 0) M << w, -z, y, z, w, -x, -y, x, w;
  if (k == 1) M << x, y, z, y, -x, -w, z, w, -x;
  if (k == 2) M << -y, x, w, x, y, z, -w, z, -y;
  if (k == 3) M << -z, -w, x, w, -z, y, x, y, z;
  return 0.5 * (M - own * R);
}

/// The quantities that both the values and the derivatives of a conserving step need.
struct Values {
  Vector4 q1;
  Matrix3 R1;
  MeanTurn turn;
  Vector3 w1, momentum1, torque;   ///< momentum1 = I w1, body axes; own = turn^T torque + gauge force, world axes
  double gauge, excess;            ///< the gauge force gauge (|q1|^2 - 1) q_a/|q_a|^2 keeps |q1| at 1
};

/// (q1 - q0)/dt.  The stage's own rate differs where the stepper damps.
Vector4 rate_of(const Start& start, double dt, const RotationState& stage) { return 2 / dt * (stage.y - start.y); }

Values evaluate_values(const Properties& body, const Start& start, double dt, const RotationState& stage,
                       StageMotion& motion, StageForces& forces) {
  Values v;
  const Vector4 rate = rate_of(start, dt, stage);
  v.q1 = 2 * stage.y - start.y;
  v.R1 = QuaternionRotation::matrix<double>(v.q1);
  v.turn = mean_turn(dt, stage.y, rate);
  v.w1 = 2 * v.turn.arc.value * v.turn.w - start.w;
  v.momentum1 = body.inertia * v.w1;
  motion.position = 0.5 * (start.R + v.R1);
  motion.velocity = (1 / dt) * (v.R1 - start.R);
  motion.acceleration = (1 / dt) * (times_skew<double>(v.R1, v.w1) - times_skew<double>(start.R, start.w));
  forces.lever = v.turn.lever.value * motion.position;
  forces.turn = QuaternionRotation::world_rates<double>(stage.y);
  v.torque = (1 / dt) * (v.R1 * v.momentum1 - start.R * (body.inertia * start.w)) - motion.position * body.torque;
  v.gauge = 4 * body.inertia.trace() / 3 / (dt * dt);
  v.excess = v.q1.squaredNorm() - 1;
  forces.own = forces.turn.transpose() * v.torque + v.gauge * v.excess / stage.y.squaredNorm() * stage.y;
  return v;
}

}   // namespace

[[gnu::flatten]] void evaluate_conserving(const Properties& body, const Start& start, double dt,
                                          const RotationState& stage, const Shift* shift, bool with_velocity,
                                          StageMotion& motion, StageForces& forces) {
  const Values v = evaluate_values(body, start, dt, stage, motion, forces);
  if (shift == nullptr) return;
  const double by_square = 1 / stage.y.squaredNorm(), by_end_square = 2 / v.q1.squaredNorm();
  Matrix34 by_w = 2 / dt * v.turn.rates - 2 * by_square * v.turn.w * stage.y.transpose();
  by_w -= 2 * by_square * QuaternionRotation::E<double>(rate_of(start, dt, stage));
  const Eigen::RowVector4d by_u = 2 * dt * dt * v.turn.w.transpose() * by_w;
  const Matrix34 by_w1 = 2 / dt * (v.turn.arc.value * by_w + v.turn.arc.by * v.turn.w * by_u);
  const Matrix34 by_momentum = (v.R1 * body.inertia) * by_w1;
  // The unknown is q_a = (q0 + q1)/2, so q1 changes twice as fast.
  const Vector3 w1 = 4 / dt * v.w1, swept = 4 / dt * v.momentum1 - 2 * body.torque;
  const auto differentiate = [&]<int k>() {
    const Matrix3 half = half_slope<k>(v.q1, by_end_square, v.R1);
    motion.by_position.block<3, 3>(3 * k, 0) = 2 * half;
    if (with_velocity) motion.by_velocity.block<3, 3>(3 * k, 0) = 4 / dt * half;
    motion.by_acceleration.block<3, 3>(3 * k, 0) =
        times_skew<double>(half, w1) + times_skew<double>(v.R1, by_w1.col(k));
    forces.by_lever.block<3, 3>(3 * k, 0) = v.turn.lever.by * by_u(k) * motion.position + 2 * v.turn.lever.value * half;
    const Vector3 by_torque = half * swept + by_momentum.col(k);
    forces.by_own.col(k) = forces.turn.transpose() * by_torque +
                           v.gauge * by_square * (4 * v.q1(k) - 2 * v.excess * by_square * stage.y(k)) * stage.y;
    forces.by_own(k, k) += v.gauge * by_square * v.excess;
  };
  [&]<int... k>(std::integer_sequence<int, k...>) { (differentiate.template operator()<k>(), ...); }
  (std::make_integer_sequence<int, 4>());
  forces.y = stage.y;
  forces.shift_x = 1;
  forces.by_own += turn_slope(Rotation::quaternion, forces, v.torque);
}

Vector3 end_by_turn(const Start& start, double dt, const Vector4& y1) {
  const MeanTurn turn = mean_turn(dt, 0.5 * (start.y + y1), (1 / dt) * (y1 - start.y));
  return 2 * turn.arc.value * turn.w - start.w;
}

Vector3 end_by_momentum(const Properties& body, const Start& start, double dt, const Vector4& y1) {
  const Matrix3 R1 = QuaternionRotation::matrix<double>(y1);
  const Vector3 impulse = 0.5 * dt * (start.R + R1) * body.torque;
  return body.inertia.llt().solve(R1.transpose() * (start.R * (body.inertia * start.w) + impulse));
}

}   // namespace cablenet::bodies
