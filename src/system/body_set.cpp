#include "body_set.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cablenet/bodies/body_in_water.hpp"
#include "cablenet/bodies/rotation.hpp"

namespace cablenet::system {
namespace {

using Const3 = Eigen::Map<const Vector3>;
using Map3 = Eigen::Map<Vector3>;

/// cos(pitch) below which roll and yaw are hardly told apart: 0.6 degrees from the vertical.
constexpr double least_cosine = 0.01;

/// A conserving step's lever grows without limit as it nears half a turn.
bool is_in_domain(const bodies::Properties& body, const bodies::Start& start, const bodies::StepRule& rule,
                  const bodies::Vector4& y) {
  if (body.rotation == bodies::Rotation::none) return true;
  if (rule.conserving) return start.y.dot(y) > 0.5 * start.y.squaredNorm();
  if (rule.dt == 0 || body.rotation != bodies::Rotation::euler) return y.allFinite();
  const bodies::Vector4 end = start.y + (y - start.y) / rule.alpha_f;
  // A step that goes further towards 90 degrees than half the way is too coarse for what happens there.
  const double way = 0.5 * std::numbers::pi - std::abs(start.y(1));
  return std::abs(end(1) - start.y(1)) < 0.5 * way + 0.02 &&
         bodies::distance_from_singular(body.rotation, end) > least_cosine;
}

/// How a carried node's motion follows the attitude.
void differentiate(const bodies::StageMotion& motion, const bodies::StageForces& forces, const Vector3& r,
                   bool is_damped, CarriedTangent& tangent) {
  const auto fill = [&r](const bodies::Stacked& by, RowMajor<3, 4>& columns) {
    bodies::Matrix34 all;
    Eigen::Map<Eigen::Matrix<double, 12, 1>>(all.data()).noalias() = by.lazyProduct(r);
    columns = all;
  };
  fill(motion.by_position, tangent.x);
  fill(motion.by_acceleration, tangent.a);
  if (is_damped) fill(motion.by_velocity, tangent.v);
  const Vector3 lever = forces.lever * r;
  for (int k = 0; k < tangent.unknowns; ++k) tangent.load.col(k) = forces.turn.col(k).cross(lever);
}

}   // namespace

BodySet::BodySet(const partition::LocalNetwork& network, bool is_damped)
    : network_(network),
      is_damped_(is_damped),
      starts_(network.bodies.size()),
      forces_(network.bodies.size()),
      tangents_(network.carried.size()),
      blocks_(at(network.own_bodies), BodyBlock::Zero()) {
  for (std::size_t k = 0; k < tangents_.size(); ++k) tangents_[k].unknowns = unknowns(at(network.carried[k].body));
}

bodies::RotationState BodySet::rotation(std::size_t body, const NodeData& data) const {
  const LocalNode node = network_.bodies[body].node;
  if (!network_.is_owned(node)) return data.ghost_rotations[node.value() - data.owned];
  bodies::RotationState state;
  const int place = data.begin[node.value()].value() + 3, n = unknowns(body);
  std::copy_n(data.x + place, n, state.y.data());
  std::copy_n(data.v + place, n, state.dy.data());
  if (data.a != nullptr) std::copy_n(data.a + place, n, state.ddy.data());
  return state;
}

void BodySet::begin_step(const NodeData& data) {
  const AnyNodes nodes{data};
  for (std::size_t b = 0; b < starts_.size(); ++b) {
    const partition::LocalBody& body = network_.bodies[b];
    const bodies::RotationState state = rotation(b, data);
    starts_[b] = bodies::start_of(body.properties, state.y, state.dy);
    const Vector3 w = starts_[b].w;
    for (int k = body.first_carried; k < body.first_carried + body.carried; ++k) {
      const auto& [node, index, r] = network_.carried[at(k)];
      NodeMotion& here = data.outside[node.value() - data.owned];
      Map3(here.x) = Const3(nodes.x(body.node)) + starts_[b].R * r;
      Map3(here.v) = Const3(nodes.v(body.node)) + starts_[b].R * w.cross(r);
    }
  }
}

bool BodySet::place(const Stage& stage, bool conserving, const NodeData& data, const Shift* shift) {
  const AnyNodes nodes{data};
  bodies::StageMotion motion;
  outside_ = -1;
  for (std::size_t b = 0; b < forces_.size(); ++b) {
    const partition::LocalBody& body = network_.bodies[b];
    const bool turns_freely = body.properties.rotation == bodies::Rotation::quaternion;
    const bodies::StepRule rule{stage.dt > 0 ? stage.alpha_f : 1, stage.dt, conserving && turns_freely};
    const bodies::RotationState state = rotation(b, data);
    if (!is_in_domain(body.properties, starts_[b], rule, state.y)) outside_ = static_cast<int>(b);
    const bool gets_tangent = shift != nullptr && unknowns(b) > 0;
    bodies::evaluate(body.properties, starts_[b], rule, state, gets_tangent ? shift : nullptr, is_damped_, motion,
                     forces_[b]);
    for (int k = body.first_carried; k < body.first_carried + body.carried; ++k) {
      const auto& [node, index, r] = network_.carried[at(k)];
      NodeMotion& here = data.outside[node.value() - data.owned];
      Map3(here.x) = Const3(nodes.x(body.node)) + motion.position * r;
      Map3(here.v) = Const3(nodes.v(body.node)) + motion.velocity * r;
      if (data.a != nullptr) Map3(here.a) = Const3(nodes.a(body.node)) + motion.acceleration * r;
      Map3(data.outside_r + 3 * std::ptrdiff_t{node.value() - data.owned}).setZero();
      if (shift != nullptr) differentiate(motion, forces_[b], r, is_damped_, tangents_[at(k)]);
    }
  }
  return outside_ < 0;
}

const CarriedTangent& BodySet::carried_tangent(LocalNode node) const {
  return tangents_[tangents_.size() - at(network_.nodes - node.value())];
}

BodyBlock* BodySet::block_at(LocalNode node) {
  const int body = network_.carried_at(node).body;
  return body < network_.own_bodies ? &blocks_[at(body)] : nullptr;
}

BodySet::Sums BodySet::sums(std::size_t b, const NodeData& data) const {
  const partition::LocalBody& body = network_.bodies[b];
  Sums sums{Vector3::Zero(), bodies::Moments::Zero()};
  for (int k = body.first_carried; k < body.first_carried + body.carried; ++k) {
    const auto& [node, index, r] = network_.carried[at(k)];
    const Const3 force(data.outside_r + 3 * std::ptrdiff_t{node.value() - data.owned});
    sums.force += force;
    sums.moments += force * r.transpose();
  }
  return sums;
}

void BodySet::add_water(const environment::Fluid& fluid, double t, const NodeData& data, const Shift* follow,
                        bool follows_turning) {
  const AnyNodes nodes{data};
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const partition::LocalBody& body = network_.bodies[b];
    const bool turns = unknowns(b) > 0;
    const Matrix3 R = turns ? forces_[b].lever : Matrix3(body.properties.attitude.toRotationMatrix());
    const bodies::PointMotion motion{Const3(nodes.x(body.node)), Const3(nodes.v(body.node)),
                                     Const3(nodes.a(body.node))};
    const bodies::BodyLoad load = bodies::body_load(*body.water, fluid, t, R, motion);
    if (data.r != nullptr) Map3(data.r + data.begin[body.node.value()].value()) -= load.force;
    if (follow == nullptr) continue;
    blocks_[b].topLeftCorner<3, 3>() -= follow->x * load.by_x + follow->v * load.by_v + follow->a * load.by_a;
    for (int k = 0; follows_turning && k < unknowns(b); ++k)
      blocks_[b].block<3, 1>(0, 3 + k) -= load.by_rotation(R, forces_[b].by_lever.middleRows<3>(3 * k));
  }
}

void BodySet::collect(const NodeData& data, TangentMatrix* tangent, double steadiness) {
  const std::array<double*, 2> values = tangent != nullptr ? tangent->open() : std::array<double*, 2>{};
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const Sums sum = sums(b, data);
    const Vector3 torque = bodies::torque_of(forces_[b].lever, sum.moments);
    if (data.r != nullptr) add_forces(b, sum, torque, data);
    if (steadiness > 0) add_steadiness(b, steadiness * largest_torque(b, data));
    if (tangent != nullptr) write_block(b, sum, torque, values[0], tangent->body_slots()[b]);
  }
  if (tangent != nullptr) tangent->close();
}

/// A torque's derivative by a quaternion couples turning with the quaternion's length, which therefore needs as much.
void BodySet::add_steadiness(std::size_t b, double stiffness) {
  const bodies::StageForces& forces = forces_[b];
  bodies::Matrix4 held = forces.turn.transpose() * forces.turn;
  if (network_.bodies[b].properties.rotation == bodies::Rotation::quaternion)
    held = 4 / forces.y.squaredNorm() * bodies::Matrix4::Identity();
  blocks_[b].block<4, 4>(3, 3) += stiffness * held;
}

/// That the forces on the carried nodes and the constant one can have.
double BodySet::largest_torque(std::size_t b, const NodeData& data) const {
  const partition::LocalBody& body = network_.bodies[b];
  double torque = body.properties.torque.norm();
  for (int k = body.first_carried; k < body.first_carried + body.carried; ++k) {
    const auto& [node, index, r] = network_.carried[at(k)];
    torque += Const3(data.outside_r + 3 * std::ptrdiff_t{node.value() - data.owned}).norm() * r.norm();
  }
  return torque;
}

void BodySet::add_forces(std::size_t b, const Sums& sum, const Vector3& torque, const NodeData& data) const {
  double* const r = data.r + data.begin[network_.bodies[b].node.value()].value();
  Map3(r) += sum.force;
  const bodies::Vector4 rows = forces_[b].own + forces_[b].turn.transpose() * torque;
  for (int k = 0; k < unknowns(b); ++k) r[3 + k] += rows(k);
}

void BodySet::write_block(std::size_t b, const Sums& sum, const Vector3& torque, double* values,
                          const TangentMatrix::Slot& slot) {
  const bodies::StageForces& forces = forces_[b];
  const int n = unknowns(b);
  BodyBlock& block = blocks_[b];
  // As torque_of(), for all unknowns at once.
  const bodies::Stacked m = forces.by_lever.lazyProduct(sum.moments.transpose());
  bodies::Matrix34 by_torque;
  for (int k = 0; k < 4; ++k)
    by_torque.col(k) << m(3 * k + 1, 2) - m(3 * k + 2, 1), m(3 * k + 2, 0) - m(3 * k, 2), m(3 * k, 1) - m(3 * k + 1, 0);
  if (n > 0)
    block.block<4, 4>(3, 3) += forces.by_own + forces.turn.transpose() * by_torque +
                               bodies::turn_slope(network_.bodies[b].properties.rotation, forces, torque);
  double* to = values + slot.offset;
  for (int i = 0; i < 3 + n; ++i, to += slot.stride) {
    if (slot.add)
      for (int j = 0; j < 3 + n; ++j) to[j] += block(i, j);
    else
      for (int j = 0; j < 3 + n; ++j) to[j] = block(i, j);
  }
  block.setZero();
}

double BodySet::end_step(const Stage& stage, bool conserving, double* x, double* v) const {
  double work = 0;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const partition::LocalBody& body = network_.bodies[b];
    const int place = network_.begin[body.node].value() + 3, n = unknowns(b);
    bodies::RotationState state;
    std::copy_n(x + place, n, state.y.data());
    std::copy_n(v + place, n, state.dy.data());
    Vector3 w;
    if (conserving && body.properties.rotation == bodies::Rotation::quaternion) {
      w = body.carried == 0 ? bodies::end_by_momentum(body.properties, starts_[b], stage.dt, state.y)
                            : bodies::end_by_turn(starts_[b], stage.dt, state.y);
      const Quaternion attitude = bodies::attitude(body.properties, state.y);
      state = bodies::rotation_state(body.properties.rotation, attitude, w);
      std::copy_n(state.y.data(), n, x + place);
      std::copy_n(state.dy.data(), n, v + place);
    } else {
      w = bodies::angular_velocity(body.properties.rotation, state);
    }
    if (n > 0) work += 0.5 * stage.dt * body.properties.torque.dot(starts_[b].w + w);
  }
  return work;
}

}   // namespace cablenet::system
