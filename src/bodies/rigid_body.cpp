#include "cablenet/bodies/rigid_body.hpp"

#include <cmath>
#include <numbers>
#include <unsupported/Eigen/AutoDiff>

#include "cablenet/bodies/euler.hpp"
#include "cablenet/bodies/small_turn.hpp"
#include "conserving.hpp"

namespace cablenet::bodies {
namespace {

/// The values of StageMotion and StageForces.  Their number type S may carry derivatives.
template <class S, int n>
struct Maps {
  Mat3<S> position, velocity, acceleration, lever;
  Eigen::Matrix<S, 3, n> turn;
  Unknowns<S, n> own;
};

template <class S, int n>
struct AttitudeMotion {
  Unknowns<S, n> y, dy, ddy;
};

/// The gauge's frequency s times the step.
constexpr double gauge_rate = 0.1;

double value_of(double number) { return number; }
template <class Derivatives>
double value_of(const Eigen::AutoDiffScalar<Derivatives>& number) {
  return number.value();
}

bool has_drag(const Properties& body) { return (body.linear_drag + body.quadratic_drag).sum() > 0; }

/// Adds the drag to the torque that the motion needs.
template <class S>
void add_drag(const Properties& body, const Vec3<S>& w, Vec3<S>& torque) {
  for (int i = 0; i < 3; ++i) {
    const double quadratic = value_of(w(i)) < 0 ? -body.quadratic_drag(i) : body.quadratic_drag(i);
    torque(i) += (body.linear_drag(i) + quadratic * w(i)) * w(i);
  }
}

template <class S>
Vec3<S> cross(const Vec3<S>& a, const Vec3<S>& b) {
  return {a(1) * b(2) - a(2) * b(1), a(2) * b(0) - a(0) * b(2), a(0) * b(1) - a(1) * b(0)};
}

template <class S>
void add_gauge(const Properties& body, double dt, const AttitudeMotion<S, 4>& m, Unknowns<S, 4>& own) {
  const double s = dt > 0 ? gauge_rate / dt : 1;
  const S g = 0.5 * (m.y.squaredNorm() - 1.0), dg = m.y.dot(m.dy), ddg = m.y.dot(m.ddy) + m.dy.squaredNorm();
  const S force = 4 * body.inertia.trace() / 3 * (ddg + 2 * s * dg + s * s * g);
  own += force * m.y;
}

template <class S>
void add_gauge(const Properties&, double, const AttitudeMotion<S, 3>&, Unknowns<S, 3>&) {}

template <class Way, class S>
Maps<S, Way::unknowns> stage_maps(const Properties& body, const Start& start, const StepRule& rule,
                                  const AttitudeMotion<S, Way::unknowns>& m) {
  constexpr int n = Way::unknowns;
  const Turning<S, n> t = Way::turning(m.y, m.dy, m.ddy);
  const double after = 1 / rule.alpha_f, before = 1 - after;
  const Unknowns<S, n> y1 = before * start.y.head<n>().template cast<S>() + after * m.y;
  const Unknowns<S, n> dy1 = before * start.dy.head<n>().template cast<S>() + after * m.dy;
  const Mat3<S> R1 = Way::matrix(y1);
  const Vec3<S> w1 = Way::rates(y1) * dy1;
  const Matrix3 velocity0 = start.R * skew<double>(start.w);
  Maps<S, n> maps;
  maps.position = ((1 - rule.alpha_f) * start.R).template cast<S>() + rule.alpha_f * R1;
  maps.velocity = ((1 - rule.alpha_f) * velocity0).template cast<S>() + rule.alpha_f * times_skew(R1, w1);
  const Mat3<S> swept = times_skew(t.R, t.w);
  maps.acceleration = times_skew(t.R, t.dw) + times_skew(swept, t.w);
  maps.lever = t.R;
  maps.turn = t.R * t.rates;
  Vec3<S> torque = times(body.inertia, t.dw) + cross<S>(t.w, times(body.inertia, t.w)) - body.torque.cast<S>();
  if (has_drag(body)) add_drag<S>(body, t.w, torque);
  maps.own = t.rates.transpose() * torque;
  add_gauge(body, rule.dt, m, maps.own);
  return maps;
}

template <class S, int n>
void copy_values(const Maps<S, n>& from, StageMotion& motion, StageForces& forces) {
  const auto value = [](const S& number) { return value_of(number); };
  motion.position = from.position.unaryExpr(value);
  motion.velocity = from.velocity.unaryExpr(value);
  motion.acceleration = from.acceleration.unaryExpr(value);
  forces.lever = from.lever.unaryExpr(value);
  forces.turn.template leftCols<n>() = from.turn.unaryExpr(value);
  forces.own.template head<n>() = from.own.unaryExpr(value);
  if constexpr (n < 4) forces.turn.col(3).setZero(), forces.own(3) = 0;
}

template <class S>
void stack(const Mat3<S>& from, int unknowns, Stacked& to) {
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k < unknowns; ++k)
      for (int i = 0; i < 3; ++i) to(3 * k + i, j) = from(i, j).derivatives()(k);
}

template <class S, int n>
void copy_derivatives(const Maps<S, n>& from, StageMotion& motion, StageForces& forces) {
  stack(from.position, n, motion.by_position);
  stack(from.velocity, n, motion.by_velocity);
  stack(from.acceleration, n, motion.by_acceleration);
  stack(from.lever, n, forces.by_lever);
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < n; ++i) forces.by_own(i, k) = from.own(i).derivatives()(k);
}

template <class Way>
void evaluate_with(const Properties& body, const Start& start, const StepRule& rule, const RotationState& stage,
                   const Shift* shift, StageMotion& motion, StageForces& forces) {
  constexpr int n = Way::unknowns;
  if (shift == nullptr) {
    const AttitudeMotion<double, n> m{stage.y.head<n>(), stage.dy.head<n>(), stage.ddy.head<n>()};
    return copy_values(stage_maps<Way, double>(body, start, rule, m), motion, forces);
  }
  using Number = Eigen::AutoDiffScalar<Unknowns<double, n>>;
  AttitudeMotion<Number, n> m;
  for (int i = 0; i < n; ++i) {
    m.y(i) = Number(stage.y(i), shift->x * Unknowns<double, n>::Unit(i));
    m.dy(i) = Number(stage.dy(i), shift->v * Unknowns<double, n>::Unit(i));
    m.ddy(i) = Number(stage.ddy(i), shift->a * Unknowns<double, n>::Unit(i));
  }
  const Maps<Number, n> maps = stage_maps<Way, Number>(body, start, rule, m);
  copy_values(maps, motion, forces);
  copy_derivatives(maps, motion, forces);
  forces.y = stage.y;
  forces.shift_x = shift->x;
}

/// The quaternion of roll, pitch and yaw.  Its sign is continuous in them.
Quaternion by_angles(const Vector3& y) {
  using Turn = Eigen::AngleAxisd;
  return Turn(y(2), Vector3::UnitZ()) * Turn(y(1), Vector3::UnitY()) * Turn(y(0), Vector3::UnitX());
}

}   // namespace

int rotation_unknowns(Rotation rotation) {
  return rotation == Rotation::quaternion ? 4 : rotation == Rotation::euler ? 3 : 0;
}

RotationState rotation_state(Rotation rotation, const Quaternion& attitude, const Vector3& w) {
  RotationState state;
  if (rotation == Rotation::quaternion) {
    state.y << attitude.w(), attitude.vec();
    const Quaternion rate = attitude * Quaternion(0, 0.5 * w.x(), 0.5 * w.y(), 0.5 * w.z());
    state.dy << rate.w(), rate.vec();
  }
  if (rotation == Rotation::euler) {
    const Matrix3 R = attitude.toRotationMatrix();
    Vector3 y(std::atan2(R(2, 1), R(2, 2)), -std::asin(std::clamp(R(2, 0), -1.0, 1.0)), std::atan2(R(1, 0), R(0, 0)));
    // A whole turn of yaw changes nothing but the quaternion's sign, which has to agree with the attitude's.
    if (by_angles(y).dot(attitude) < 0) y(2) += 2 * std::numbers::pi;
    state.y.head<3>() = y;
    state.dy.head<3>() = EulerRotation::rates<double>(y).inverse() * w;
  }
  return state;
}

Quaternion attitude(const Properties& body, const Vector4& y) {
  if (body.rotation == Rotation::quaternion) return Quaternion(y(0), y(1), y(2), y(3)).normalized();
  if (body.rotation == Rotation::none) return body.attitude;
  return by_angles(y.head<3>());
}

Eigen::Matrix<double, 4, 3> small_turn(const Properties& body, const Vector4& y) {
  const Quaternion now = attitude(body, y);
  const Matrix3 to_body = now.toRotationMatrix().transpose();
  Eigen::Matrix<double, 4, 3> columns;
  for (int i = 0; i < 3; ++i) columns.col(i) = rotation_state(body.rotation, now, to_body.col(i)).dy;
  return columns;
}

Vector3 angular_velocity(Rotation rotation, const RotationState& state) {
  if (rotation == Rotation::quaternion) return QuaternionRotation::rates<double>(state.y) * state.dy;
  if (rotation == Rotation::none) return Vector3::Zero();
  return EulerRotation::rates<double>(state.y.head<3>()) * state.dy.head<3>();
}

double distance_from_singular(Rotation rotation, const Vector4& y) {
  return rotation == Rotation::euler ? std::cos(y(1)) : 1;
}

Start start_of(const Properties& body, const Vector4& y, const Vector4& dy) {
  Start start{y, dy, body.attitude.toRotationMatrix(), angular_velocity(body.rotation, {y, dy, {}})};
  if (body.rotation == Rotation::quaternion) start.R = QuaternionRotation::matrix<double>(y);
  if (body.rotation == Rotation::euler) start.R = EulerRotation::matrix<double>(y.head<3>());
  return start;
}

void evaluate(const Properties& body, const Start& start, const StepRule& rule, const RotationState& stage,
              const Shift* shift, bool with_velocity, StageMotion& motion, StageForces& forces) {
  if (rule.conserving) return evaluate_conserving(body, start, rule.dt, stage, shift, with_velocity, motion, forces);
  if (body.rotation == Rotation::quaternion)
    return evaluate_with<QuaternionRotation>(body, start, rule, stage, shift, motion, forces);
  if (body.rotation == Rotation::euler)
    return evaluate_with<EulerRotation>(body, start, rule, stage, shift, motion, forces);
  motion.position = body.attitude.toRotationMatrix();
  motion.velocity.setZero();
  motion.acceleration.setZero();
  forces.lever.setZero();
  forces.turn.setZero();
  forces.own.setZero();
}

Matrix4 turn_slope(Rotation rotation, const StageForces& forces, const Vector3& T) {
  Matrix4 slope = Matrix4::Zero();
  if (rotation == Rotation::quaternion) {
    // turn^T T = 2/|q|^2 G(q)^T T, where G is linear in q: G(q)^T T = slope q.
    slope << 0, -T(0), -T(1), -T(2), T(0), 0, -T(2), T(1), T(1), T(2), 0, -T(0), T(2), -T(1), T(0), 0;
    const double s = 2 * forces.shift_x / forces.y.squaredNorm();
    return s * (slope - (forces.turn.transpose() * T) * forces.y.transpose());
  }
  using Number = Eigen::AutoDiffScalar<Vector3>;
  Unknowns<Number, 3> y;
  for (int i = 0; i < 3; ++i) y(i) = Number(forces.y(i), forces.shift_x * Vector3::Unit(i));
  const Mat3<Number> turn = EulerRotation::matrix(y) * EulerRotation::rates(y);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j) slope(i, k) += turn(j, i).derivatives()(k) * T(j);
  return slope;
}

Vector3 torque_of(const Matrix3& lever, const Moments& moments) {
  const Matrix3 m = lever * moments.transpose();
  return {m(1, 2) - m(2, 1), m(2, 0) - m(0, 2), m(0, 1) - m(1, 0)};
}

}   // namespace cablenet::bodies
