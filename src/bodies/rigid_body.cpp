#include "cablenet/bodies/rigid_body.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <unsupported/Eigen/AutoDiff>

#include "cablenet/bodies/rotation.hpp"

namespace cablenet::bodies {
namespace {

template <class S, int n>
struct Maps {
  Mat3<S> place, velocity, acceleration, lever;
  Eigen::Matrix<S, 3, n> turn;
  Unknowns<S, n> own;
};

template <class S, int n>
struct Motion {
  Unknowns<S, n> y, dy, ddy;
};

/// Of the gauge's frequency by the step.
constexpr double gauge_rate = 0.1;

template <class S>
Vec3<S> cross(const Vec3<S>& a, const Vec3<S>& b) {
  return {a(1) * b(2) - a(2) * b(1), a(2) * b(0) - a(0) * b(2), a(0) * b(1) - a(1) * b(0)};
}

/// 4 atan(x/4)/x by u = x^2; the series is exact to rounding where it is used.
template <class S>
S arc_by_tangent(const S& u) {
  const S z = u / 16.0;
  if (z < 0.01) {
    S sum(0);
    for (int k = 8; k >= 0; --k) sum = 1.0 / (2 * k + 1) - z * sum;
    return sum;
  }
  using std::atan2, std::sqrt;
  const S root = sqrt(z);
  return atan2(root, S(1.0)) / root;
}

/// How a conserving step turns.
template <class S>
struct MeanTurn {
  Vec3<S> W;   ///< R1 = R0 exp(dt W)
  S lever;     ///< tan(dt |W|/2)/(dt |W|/2): on a lever (R0 + R1) r/2 a force then does the work that it does at r
};

/// The rate at the middle of q0 and q1 is 4 tan(dt |W|/4)/dt along W.
template <class S>
MeanTurn<S> mean_turn(double dt, const Unknowns<S, 4>& middle, const Unknowns<S, 4>& rate) {
  const Vec3<S> w = QuaternionRotation::rates(middle) * rate;
  const S u = dt * dt * w.squaredNorm();
  const S arc = arc_by_tangent<S>(u);
  return {arc * w, 1.0 / ((1.0 - u / 16.0) * arc)};
}

template <class S>
Maps<S, 4> conserving_maps(const Properties& body, const Start& start, double dt, const Motion<S, 4>& m) {
  const Unknowns<S, 4> q0 = start.y.cast<S>();
  const Unknowns<S, 4> q1 = 2.0 * m.y - q0;
  const Mat3<S> R0 = start.R.cast<S>(), R1 = QuaternionRotation::matrix(q1);
  const MeanTurn<S> turn = mean_turn<S>(dt, m.y, m.dy);
  const Vec3<S> w1 = 2.0 * turn.W - start.w.cast<S>();
  Maps<S, 4> maps;
  maps.place = 0.5 * (R0 + R1);
  maps.velocity = (1 / dt) * (R1 - R0);
  maps.acceleration = (1 / dt) * (times_skew(R1, w1) - (start.R * skew<double>(start.w)).cast<S>());
  maps.lever = turn.lever * maps.place;
  const S length = m.y.squaredNorm();
  maps.turn = QuaternionRotation::world_rates(m.y);
  const Vec3<S> momentum = R1 * times(body.inertia, w1) - (start.R * (body.inertia * start.w)).cast<S>();
  const Vec3<S> torque = (1 / dt) * momentum - maps.place * body.torque.cast<S>();
  const S excess = 4 * body.inertia.trace() / 3 / (dt * dt) * (q1.squaredNorm() - 1.0);
  maps.own = maps.turn.transpose() * torque + (excess / length) * m.y;
  return maps;
}

template <class S>
void add_gauge(const Properties& body, double dt, const Motion<S, 4>& m, Unknowns<S, 4>& own) {
  const double s = dt > 0 ? gauge_rate / dt : 0;
  const S g = 0.5 * (m.y.squaredNorm() - 1.0), dg = m.y.dot(m.dy), ddg = m.y.dot(m.ddy) + m.dy.squaredNorm();
  const S force = 4 * body.inertia.trace() / 3 * (ddg + 2 * s * dg + s * s * g);
  own += force * m.y;
}

template <class S>
void add_gauge(const Properties&, double, const Motion<S, 3>&, Unknowns<S, 3>&) {}

template <class Way, class S>
Maps<S, Way::unknowns> stage_maps(const Properties& body, const Start& start, const StepRule& rule,
                                  const Motion<S, Way::unknowns>& m) {
  constexpr int n = Way::unknowns;
  const Turning<S, n> t = Way::turning(m.y, m.dy, m.ddy);
  const double after = 1 / rule.alpha_f, before = 1 - after;
  const Unknowns<S, n> y1 = before * start.y.head<n>().template cast<S>() + after * m.y;
  const Unknowns<S, n> dy1 = before * start.dy.head<n>().template cast<S>() + after * m.dy;
  const Mat3<S> R1 = Way::matrix(y1);
  const Vec3<S> w1 = Way::rates(y1) * dy1;
  const Matrix3 velocity0 = start.R * skew<double>(start.w);
  Maps<S, n> maps;
  maps.place = ((1 - rule.alpha_f) * start.R).template cast<S>() + rule.alpha_f * R1;
  maps.velocity = ((1 - rule.alpha_f) * velocity0).template cast<S>() + rule.alpha_f * times_skew(R1, w1);
  const Mat3<S> swept = times_skew(t.R, t.w);
  maps.acceleration = times_skew(t.R, t.dw) + times_skew(swept, t.w);
  maps.lever = t.R;
  maps.turn = t.R * t.rates;
  const Vec3<S> torque = times(body.inertia, t.dw) + cross<S>(t.w, times(body.inertia, t.w)) - body.torque.cast<S>();
  maps.own = t.rates.transpose() * torque;
  add_gauge(body, rule.dt, m, maps.own);
  return maps;
}

template <class Way, class S>
Maps<S, Way::unknowns> maps_of(const Properties& body, const Start& start, const StepRule& rule,
                               const Motion<S, Way::unknowns>& m) {
  if constexpr (Way::unknowns == 4)
    if (rule.conserving) return conserving_maps(body, start, rule.dt, m);
  return stage_maps<Way>(body, start, rule, m);
}

/// Copies values, or derivatives by one unknown, as `read` takes them from a number.
template <class S, int n, class Read>
void copy(const Maps<S, n>& from, StageMaps& to, Read&& read) {
  to.place = from.place.unaryExpr(read);
  to.velocity = from.velocity.unaryExpr(read);
  to.acceleration = from.acceleration.unaryExpr(read);
  to.lever = from.lever.unaryExpr(read);
  to.turn.setZero();
  to.turn.template leftCols<n>() = from.turn.unaryExpr(read);
  to.own.setZero();
  to.own.template head<n>() = from.own.unaryExpr(read);
}

template <class Way>
[[gnu::flatten]] void evaluate_with(const Properties& body, const Start& start, const StepRule& rule,
                                    const RotationState& stage, const Seeds* seeds, Stage& result) {
  constexpr int n = Way::unknowns;
  if (seeds == nullptr) {
    const Motion<double, n> m{stage.y.head<n>(), stage.dy.head<n>(), stage.ddy.head<n>()};
    return copy(maps_of<Way, double>(body, start, rule, m), result.at, [](double value) { return value; });
  }
  using Number = Eigen::AutoDiffScalar<Unknowns<double, n>>;
  Motion<Number, n> m;
  for (int i = 0; i < n; ++i) {
    m.y(i) = Number(stage.y(i), seeds->position * Unknowns<double, n>::Unit(i));
    m.dy(i) = Number(stage.dy(i), seeds->velocity * Unknowns<double, n>::Unit(i));
    m.ddy(i) = Number(stage.ddy(i), seeds->acceleration * Unknowns<double, n>::Unit(i));
  }
  const Maps<Number, n> maps = maps_of<Way, Number>(body, start, rule, m);
  copy(maps, result.at, [](const Number& number) { return number.value(); });
  for (std::size_t k = 0; k < n; ++k)
    copy(maps, result.by[k], [k](const Number& number) { return number.derivatives()(static_cast<Eigen::Index>(k)); });
}

}   // namespace

int rotation_unknowns(Rotation rotation) {
  return rotation == Rotation::quaternion ? 4 : rotation == Rotation::euler ? 3 : 0;
}

RotationState rotation_state(Rotation rotation, const Quaternion& attitude, const Vector3& w) {
  RotationState state;
  if (rotation == Rotation::quaternion) {
    state.y << attitude.w(), attitude.vec();
    state.dy << 0, 0, 0, 0;
    const Quaternion rate = attitude * Quaternion(0, 0.5 * w.x(), 0.5 * w.y(), 0.5 * w.z());
    state.dy << rate.w(), rate.vec();
  }
  if (rotation == Rotation::euler) {
    const Matrix3 R = attitude.toRotationMatrix();
    const Vector3 y(std::atan2(R(2, 1), R(2, 2)), -std::asin(std::clamp(R(2, 0), -1.0, 1.0)),
                    std::atan2(R(1, 0), R(0, 0)));
    state.y.head<3>() = y;
    state.dy.head<3>() = EulerRotation::rates<double>(y).inverse() * w;
  }
  return state;
}

Quaternion attitude(const Properties& body, const Vector4& y) {
  if (body.rotation == Rotation::quaternion) return Quaternion(y(0), y(1), y(2), y(3)).normalized();
  if (body.rotation == Rotation::none) return Quaternion(body.attitude);
  using Turn = Eigen::AngleAxisd;
  return Turn(y(2), Vector3::UnitZ()) * Turn(y(1), Vector3::UnitY()) * Turn(y(0), Vector3::UnitX());
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
  Start start{y, dy, body.attitude, angular_velocity(body.rotation, {y, dy, {}})};
  if (body.rotation == Rotation::quaternion) start.R = QuaternionRotation::matrix<double>(y);
  if (body.rotation == Rotation::euler) start.R = EulerRotation::matrix<double>(y.head<3>());
  return start;
}

void evaluate(const Properties& body, const Start& start, const StepRule& rule, const RotationState& stage,
              const Seeds* seeds, Stage& result) {
  if (body.rotation == Rotation::quaternion)
    evaluate_with<QuaternionRotation>(body, start, rule, stage, seeds, result);
  else if (body.rotation == Rotation::euler)
    evaluate_with<EulerRotation>(body, start, rule, stage, seeds, result);
  else
    result.at = {body.attitude, Matrix3::Zero(), Matrix3::Zero(), Matrix3::Zero(), Matrix34::Zero(), Vector4::Zero()};
}

Vector3 end_by_turn(const Start& start, double dt, const Vector4& y1) {
  const Vector4 middle = 0.5 * (start.y + y1), rate = (1 / dt) * (y1 - start.y);
  return 2 * mean_turn<double>(dt, middle, rate).W - start.w;
}

Vector3 end_by_momentum(const Properties& body, const Start& start, double dt, const Vector4& y1) {
  const Matrix3 R1 = QuaternionRotation::matrix<double>(y1);
  const Vector3 impulse = 0.5 * dt * (start.R + R1) * body.torque;
  return body.inertia.llt().solve(R1.transpose() * (start.R * (body.inertia * start.w) + impulse));
}

Vector3 torque_of(const Matrix3& lever, const Moments& moments) {
  const Matrix3 m = lever * moments.transpose();
  return {m(1, 2) - m(2, 1), m(2, 0) - m(0, 2), m(0, 1) - m(1, 0)};
}

}   // namespace cablenet::bodies
