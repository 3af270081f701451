#include "cablenet/solve/local_error.hpp"

#include <algorithm>
#include <cmath>

#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/bodies/rigid_body.hpp"
#include "cablenet/petsc/values.hpp"

namespace cablenet::solve {

using bodies::Rotation, bodies::Vector4;

/// A step to be estimated, with its vectors open.
struct OpenStep {
  const AlphaStep& step;
  const partition::LocalNetwork& network;
  JerkWeights weights;
  std::span<const double> growth;
  petsc::ReadValues x0, v0, a0, x1;

  /// Of n unknowns.
  template <int n>
  Curve<Eigen::Matrix<double, n, 1>> curve(int first) const {
    using Values = Eigen::Matrix<double, n, 1>;
    const auto at = [first](const double* values) { return Eigen::Map<const Values>(values + first); };
    const Values way = at(x1) - at(x0) - step.dt * at(v0), now = at(a0);
    return {weights, way, at(v0), now, growth.empty() ? now : now - at(growth.data())};
  }
};

namespace {

/// The error of a step over dt^3 x'''.
double constant_of(const AlphaStep& step) { return std::abs(step.beta + (step.alpha_f - step.alpha_m) / 2 - 1.0 / 6); }
constexpr double conserving_constant = 1.0 / 12;

Vector4 four(const Vector3& of) { return {of(0), of(1), of(2), 0}; }

/// Where a rope is caught within a step, or let go, a force that does not conserve energy errs by more than in a smooth
/// motion: what it gives and takes back differs.
constexpr double caught_factor = 3;

/// Of the attitude's unknowns.  Components that a body does not have are zero.
Curve<Vector4> attitude_curve(const OpenStep& open, Rotation rotation, int first) {
  if (rotation == Rotation::quaternion) return open.curve<4>(first);
  const Curve<Vector3> angles = open.curve<3>(first);
  return {four(angles.v), four(angles.a), four(angles.jerk)};
}

/// A length on which a motion turns: a circle's radius, and a vibration's amplitude.  [m]
double scale_of(const Vector3& v, const Vector3& jerk) {
  const double size = jerk.norm();
  return size > 0 ? v.norm() * std::sqrt(std::abs(v.dot(jerk))) / size : 0;
}

}   // namespace

double turned_way(const partition::LocalBody& body, const double* unknowns) {
  bodies::Vector4 y = bodies::Vector4::Zero();
  std::copy_n(unknowns, bodies::rotation_unknowns(body.properties.rotation), y.data());
  const Quaternion start = bodies::attitude(body.properties, body.start.y);
  return 2 * body.reach * std::sin(start.angularDistance(bodies::attitude(body.properties, y)) / 2);
}

/// An error counts over the time in which the motion turns by `memory`, at most `longest_`, at least the step.  A
/// radian takes sqrt(|v|/|x'''|), v the part of x' along x''': what moves steadily across it is no part of the turn.
/// @returns |x'''| times that time, in units of x''
double LocalError::weighed(const Vector3& v, const Vector3& jerk, double dt) const {
  const double size = jerk.norm(), over_memory = memory * std::sqrt(std::abs(v.dot(jerk)));
  return std::max(dt * size, std::min(over_memory, longest_ * size));
}

/// A rope that is caught loses up to xi EA/L (l1 - l0)^2 to the axial dissipation, and so does one that goes slack.
/// The speed lacks that for good: xi dt^2 |x'''|.
double LocalError::of_nodes(const OpenStep& open) const {
  const double constant = constant_of(open.step), lasting = axial_dissipation_ * longest_;
  double largest = 0;
  for (LocalNode node(0); open.network.is_owned(node); ++node) {
    const Curve<Vector3> path = open.curve<3>(open.network.begin[node].value());
    largest = std::max(largest, constant * weighed(path.v, path.jerk, open.step.dt));
    if (means_ != nullptr) add_node(open, node, path);
    if (can_slacken_[node]) largest = std::max(largest, lasting * path.jerk.norm());
  }
  return largest;
}

void LocalError::add_node(const OpenStep& open, LocalNode node, const Curve<Vector3>& path) const {
  const double dt = open.step.dt,
               constant = constant_of(open.step) * (can_slacken_[node] && !conserves_ ? caught_factor : 1);
  const Eigen::Map<const Vector3> end(open.x1 + open.network.begin[node].value());
  means_->add_mass(node);
  means_->add({means_->mass(node), constant * dt * dt * dt * path.jerk.norm(), scale_of(path.v, path.jerk),
               (end - open.network.position[node]).norm(), path.v.norm()});
}

void LocalError::add_turn(const OpenStep& open, const partition::LocalBody& body, const Turning& turning) const {
  const double dt = open.step.dt, reach = body.reach;
  means_->add({means_->mass(body.node), reach * turning.constant * dt * dt * dt * turning.jerk.norm(),
               reach * scale_of(turning.w, turning.jerk),
               turned_way(body, open.x1 + open.network.begin[body.node].value() + 3), reach * turning.w.norm()});
}

/// Where the equations hold at the stage, the attitude's unknowns err as a node does.
Turning LocalError::of_attitude(const OpenStep& open, Rotation rotation, int first, const Vector4& y0) const {
  const auto turn = [&](const Vector4& change) { return bodies::angular_velocity(rotation, {y0, change, {}}); };
  const Curve<Vector4> curve = attitude_curve(open, rotation, first);
  return {constant_of(open.step), turn(curve.v), turn(curve.jerk)};
}

/// Of a conserving step.  The rotation vector dt (w0 + w1)/2 stands in the place of a node's way.
Turning LocalError::of_turn(const OpenStep& open, std::size_t body, const bodies::Start& start, const Vector3& start_dw,
                            const Vector4& y1) {
  const double dt = open.step.dt;
  const auto of_body = [body](std::vector<double>& values) { return Eigen::Map<Vector3>(values.data() + 3 * body); };
  const Vector3 w1 = bodies::end_by_turn(start, dt, y1), mean = 0.5 * (start.w + w1);
  if (kept_.last == 0) of_body(turns_) = start_dw;
  of_body(next_turns_) = (w1 - start.w) / dt;
  const Vector3 way = dt * (mean - start.w), now = of_body(turns_), before = of_body(turns_before_);
  const Curve<Vector3> turning(open.weights, way, mean, now, before);
  return {conserving_constant, mean, turning.jerk - mean.cross(turning.a)};
}

double LocalError::of_bodies(const OpenStep& open) {
  const bool conserves = conserves_ && open.step.alpha_f == 0.5;
  double largest = 0;
  for (int b = 0; b < open.network.own_bodies; ++b) {
    const partition::LocalBody& body = open.network.bodies[at(b)];
    const Rotation rotation = body.properties.rotation;
    if (rotation == Rotation::none) continue;
    const int first = open.network.begin[body.node].value() + 3, unknowns = bodies::rotation_unknowns(rotation);
    const auto read = [first, unknowns](const double* values) {
      Vector4 result = Vector4::Zero();
      std::copy_n(values + first, unknowns, result.data());
      return result;
    };
    const bodies::Start start = bodies::start_of(body.properties, read(open.x0), read(open.v0));
    const Vector3 start_dw = bodies::angular_velocity(rotation, {start.y, read(open.a0), {}});
    const bool turns = conserves && rotation == Rotation::quaternion;
    Turning turning =
        turns ? of_turn(open, at(b), start, start_dw, read(open.x1)) : of_attitude(open, rotation, first, start.y);
    if (turns && unknown_turns_ > 0) turning.constant = 0;
    largest = std::max(largest, body.reach * turning.constant * weighed(turning.w, turning.jerk, open.step.dt));
    if (means_ != nullptr) add_turn(open, body, turning);
  }
  return largest;
}

/// Finds the nodes at which ropes that can go slack end.
void LocalError::prepare(const partition::LocalNetwork& network) {
  for (auto* turns : {&turns_, &turns_before_, &next_turns_}) turns->assign(3 * at(network.own_bodies), 0);
  can_slacken_ = Table<LocalNode, bool>(network.owned, false);
  for (const partition::LocalElement& element : network.elements)
    for (const LocalNode end : element.node)
      if (const LocalNode node = network.anchor(end); network.is_owned(node))
        can_slacken_[node] = can_slacken_[node] || network.materials[at(element.material)].tension_only;
}

double LocalError::estimate(const AlphaStep& step, const partition::LocalNetwork& network, const StepStart& start,
                            std::span<const double> growth, Vec x1) {
  is_estimated_ = true;
  if (can_slacken_.empty()) prepare(network);
  if (means_ != nullptr) means_->begin();
  const JerkWeights weights(step, kept_, !growth.empty());
  const OpenStep open{step,
                      network,
                      weights,
                      growth,
                      petsc::ReadValues(start.x),
                      petsc::ReadValues(start.v),
                      petsc::ReadValues(start.a),
                      petsc::ReadValues(x1)};
  double largest = step.dt * step.dt * std::max(of_nodes(open), of_bodies(open));
  MPI_Comm communicator = MPI_COMM_NULL;
  petsc::check(PetscObjectGetComm(reinterpret_cast<PetscObject>(x1), &communicator));
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, communicator);
  return largest;
}

void LocalError::accept(const AlphaStep& step) {
  kept_ = kept_.after(step);
  unknown_turns_ = is_estimated_ ? std::max(unknown_turns_ - 1, 0) : 2;
  if (!is_estimated_) return;
  is_estimated_ = false;
  turns_before_.swap(turns_);
  turns_.swap(next_turns_);
}

void LocalError::archive(Archive& archive) {
  kept_.archive(archive);
  archive.item("local_error.unknown_turns", unknown_turns_);
  archive.item("local_error.turns", turns_);
  archive.item("local_error.turns_before", turns_before_);
}

}   // namespace cablenet::solve
