#include "body_term.hpp"

#include <algorithm>

#include "cablenet/petsc/phase.hpp"

namespace cablenet::system {

/// cos(pitch) one degree from the vertical: before a step leaves the domain of Euler angles.
constexpr double warning_cosine = 0.0175;

BodyTerm::BodyTerm(const partition::LocalNetwork& network)
    : Term(network), starts_(network.bodies.size()), forces_(network.bodies.size()), carried_(network) {
  for (std::size_t k = 0; k < carried_.tangents.size(); ++k)
    carried_.tangents[k].unknowns = unknowns(network.carried[k].body);
}

bodies::RotationState BodyTerm::rotation(int body, const NodeData& data) const {
  const LocalNode node = network_.bodies[at(body)].node;
  if (node.value() >= data.owned) return data.ghost_rotations[node.value() - data.owned];
  bodies::RotationState state;
  const int first = data.begin[node.value()].value() + 3, n = unknowns(body);
  std::copy_n(data.x + first, n, state.y.data());
  std::copy_n(data.v + first, n, state.dy.data());
  if (data.a != nullptr) std::copy_n(data.a + first, n, state.ddy.data());
  return state;
}

std::vector<BodyState> BodyTerm::states(const NodeData& data) const {
  std::vector<BodyState> states;
  for (int b = 0; b < static_cast<int>(network_.bodies.size()); ++b) {
    const bodies::Properties& body = network_.bodies[at(b)].properties;
    const bodies::RotationState state = rotation(b, data);
    states.push_back({bodies::attitude(body, state.y), bodies::angular_velocity(body.rotation, state)});
  }
  return states;
}

void BodyTerm::start_step(const NodeData& data) {
  const AnyNodes nodes{data};
  for (std::size_t b = 0; b < starts_.size(); ++b) {
    const partition::LocalBody& body = network_.bodies[b];
    const bodies::RotationState state = rotation(static_cast<int>(b), data);
    starts_[b] = bodies::start_of(body.properties, state.y, state.dy);
    const Vector3 w = starts_[b].w;
    for (const auto& [node, index, r] : carried_by(body)) {
      NodeMotion& here = nodes.outside(node);
      here.x = nodes.x(body.node) + starts_[b].R * r;
      here.v = nodes.v(body.node) + starts_[b].R * w.cross(r);
    }
  }
}

void BodyTerm::carry(Evaluation& evaluation) {
  outside_ = -1;
  if (forces_.empty()) return;
  const petsc::Timer timer(evaluation.has_residual ? petsc::Phase::residual : petsc::Phase::tangent);
  const Stage& stage = evaluation.situation.stage;
  const bool conserves = evaluation.conserves();
  bodies::StageMotion motion;
  for (int b = 0; b < static_cast<int>(forces_.size()); ++b) {
    const bool turns_freely = network_.bodies[at(b)].properties.rotation == bodies::Rotation::quaternion;
    const bodies::StepRule rule{stage.dt > 0 ? stage.alpha_f : 1, stage.dt, conserves && turns_freely};
    carry_body(b, evaluation, rule, motion);
  }
  if (outside_ >= 0) evaluation.in_domain = false;
}

void BodyTerm::carry_body(int b, const Evaluation& evaluation, const bodies::StepRule& rule,
                          bodies::StageMotion& motion) {
  const partition::LocalBody& body = network_.bodies[at(b)];
  const NodeData& data = evaluation.data;
  const AnyNodes nodes{data};
  const bodies::RotationState state = rotation(b, data);
  if (!bodies::is_in_domain(body.properties, starts_[at(b)], rule, state.y)) outside_ = body.body;
  const bool differentiates = evaluation.has_tangent && unknowns(b) > 0;
  bodies::evaluate(body.properties, starts_[at(b)], rule, state, differentiates ? &evaluation.target.shift : nullptr,
                   evaluation.has_rates, motion, forces_[at(b)]);
  for (const auto& [node, index, r] : carried_by(body)) {
    NodeMotion& here = nodes.outside(node);
    here.x = nodes.x(body.node) + motion.position * r;
    here.v = nodes.v(body.node) + motion.velocity * r;
    if (data.a != nullptr) here.a = nodes.a(body.node) + motion.acceleration * r;
    nodes.r(node).setZero();
    if (evaluation.has_tangent)
      bodies::differentiate(motion, forces_[at(b)], r, evaluation.has_rates, *carried_.tangent(node));
  }
}

void BodyTerm::clear_blocks(const TangentTarget& target) const {
  for (int b = 0; b < network_.own_bodies; ++b) {
    double* to = target.values[0] + slots_[at(b)].offset;
    const int n = 3 + unknowns(b);
    for (int i = 0; i < n; ++i, to += slots_[at(b)].stride) std::fill_n(to, n, 0.0);
  }
}

bodies::CarriedForces BodyTerm::collect(int b, const NodeData& data) const {
  bodies::CarriedForces sum;
  for (const auto& [node, index, r] : carried_by(network_.bodies[at(b)])) {
    const ConstVector force(AnyNodes{data}.outside_r(node));
    sum.force += force;
    sum.moments += force * r.transpose();
  }
  return sum;
}

void BodyTerm::add(Evaluation& evaluation) {
  const NodeData& data = evaluation.data;
  const double steadiness = evaluation.target.steadiness;
  for (int b = 0; b < network_.own_bodies; ++b) {
    const partition::LocalBody& body = network_.bodies[at(b)];
    const bodies::StageForces& forces = forces_[at(b)];
    const bodies::CarriedForces sum = collect(b, data);
    const Vector3 torque = bodies::torque_of(forces.lever, sum.moments);
    if (evaluation.has_residual) {
      auto r = AnyNodes{data}.r(body.node);
      r += sum.force;
      const bodies::Vector4 rows = bodies::attitude_forces(forces, torque);
      for (int k = 0; k < unknowns(b); ++k) r.data()[3 + k] += rows(k);
    }
    if (!evaluation.has_tangent) continue;
    if (steadiness > 0)
      bodies::add_steadiness(body.properties, forces, steadiness * largest_torque(b, data), carried_.blocks[at(b)]);
    if (unknowns(b) > 0) bodies::add_attitude_slopes(body.properties, forces, sum, torque, carried_.blocks[at(b)]);
    add_block(b, evaluation.target);
  }
}

/// That the forces on the carried nodes and the constant one can have.
double BodyTerm::largest_torque(int b, const NodeData& data) const {
  const partition::LocalBody& body = network_.bodies[at(b)];
  double torque = body.properties.torque.norm();
  for (const auto& [node, index, r] : carried_by(body))
    torque += ConstVector(AnyNodes{data}.outside_r(node)).norm() * r.norm();
  return torque;
}

/// To the matrix, and begins anew.
void BodyTerm::add_block(int b, const TangentTarget& target) {
  const int n = 3 + unknowns(b);
  double* to = target.values[0] + slots_[at(b)].offset;
  for (int i = 0; i < n; ++i, to += slots_[at(b)].stride)
    for (int j = 0; j < n; ++j) to[j] += carried_.blocks[at(b)](i, j);
  carried_.blocks[at(b)].setZero();
}

void BodyTerm::put(int body, const bodies::RotationState& state, double* x, double* v) const {
  const int first = network_.begin[network_.bodies[at(body)].node].value() + 3;
  std::copy_n(state.y.data(), unknowns(body), x + first);
  std::copy_n(state.dy.data(), unknowns(body), v + first);
}

int BodyTerm::nearly_singular(const NodeData& data) const {
  int found = -1;
  for (int b = 0; b < network_.own_bodies; ++b) {
    const partition::LocalBody& body = network_.bodies[at(b)];
    if (bodies::distance_from_singular(body.properties.rotation, rotation(b, data).y) < warning_cosine)
      found = body.body;
  }
  return found;
}

void BodyTerm::end_step(const StepEnd& end) {
  for (int b = 0; b < network_.own_bodies; ++b) {
    if (unknowns(b) == 0) continue;
    const partition::LocalBody& body = network_.bodies[at(b)];
    const NodeData data{network_.owned, network_.begin.data(), end.x, end.v};
    bodies::RotationState state = rotation(b, data);
    const Vector3 w =
        bodies::end_velocity(body.properties, starts_[at(b)], end.stage.dt, end.conserves, body.carried == 0, state);
    put(b, state, end.x, end.v);
    work_ += 0.5 * end.stage.dt * body.properties.torque.dot(starts_[at(b)].w + w);
  }
}

void BodyTerm::add_energy(const LocalState& state, Energies& sum) const {
  sum.work += work_;
  for (int b = 0; b < network_.own_bodies; ++b) {
    const Vector3& w = state.bodies[at(b)].w;
    const partition::LocalBody& body = network_.bodies[at(b)];
    sum.kinetic += 0.5 * w.dot(body.properties.inertia * w);
    // The energy of the water around things is nowhere counted.
    if (body.water) sum.kinetic -= 0.5 * body.water->added_inertia.dot(w.cwiseAbs2());
  }
}

void BodyTerm::add_scales(const LocalState& state, ForceSums& sums) const {
  for (int b = 0; b < network_.own_bodies; ++b) {
    const partition::LocalBody& body = network_.bodies[at(b)];
    const Matrix3& inertia = body.properties.inertia;
    const Vector3& w = state.bodies[at(b)].w;
    sums.load += square(2 * w.norm() * (inertia * w).norm()) + square(2 * body.properties.torque.norm());
    sums.mass += square(4 * inertia.norm());
  }
}

}   // namespace cablenet::system
