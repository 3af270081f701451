#include "cablenet/system/assembler.hpp"

#include <algorithm>

#include "assembler_parts.hpp"
#include "cablenet/petsc/phase.hpp"

namespace cablenet::system {
namespace {

using petsc::check;

}   // namespace

Assembler::Assembler(partition::LocalNetwork network, ForceRule rule, MPI_Comm communicator)
    : network_(std::move(network)), rule_(rule), communicator_(communicator) {
  petsc::register_phases();
  parts_ = std::make_unique<Parts>(network_, communicator_);
}

Assembler::~Assembler() = default;

Vector Assembler::make_vector() const {
  Vector vector;
  check(VecCreate(communicator_, vector.out()));
  check(VecSetSizes(vector, network_.unknowns(), network_.all_unknowns()));
  if (network_.blocks.uniform()) check(VecSetBlockSize(vector, 3));
  check(VecSetFromOptions(vector));
  return vector;
}

TangentMatrix Assembler::make_tangent() const {
  bool is_symmetric = true;
  for_each_term(parts_->terms, [&](const auto& term) { is_symmetric = is_symmetric && term.is_symmetric(rule_); });
  return {network_, parts_->pattern, is_symmetric, communicator_};
}

void Assembler::fill_initial(Vec x, Vec v) const {
  const petsc::WrittenValues to_x(x), to_v(v);
  for (LocalNode node(0); network_.is_owned(node); ++node) {
    Eigen::Map<Vector3>(to_x + network_.begin[node].value()) = network_.position[node];
    Eigen::Map<Vector3>(to_v + network_.begin[node].value()) = network_.velocity[node];
  }
  for (int b = 0; b < network_.own_bodies; ++b) parts_->bodies().put(b, network_.bodies[at(b)].start, to_x, to_v);
}

void Assembler::start_from(double t, Vec x, const Vector3& velocity) {
  const Vector resting = make_vector();
  const LocalState& state = observe(t, x, resting, resting);
  for (LocalNode node(0); node.value() < network_.nodes; ++node) {
    const bool is_moved_along = network_.is_free(node) || network_.is_carried(node);
    network_.position[node] = state.position(node);
    network_.velocity[node] = is_moved_along ? velocity : Vector3(state.velocity(node));
  }
  for (partition::LocalBody& body : network_.bodies) {
    const Quaternion& attitude = state.bodies[at(&body - network_.bodies.data())].attitude;
    body.start = bodies::rotation_state(body.properties.rotation, attitude, Vector3::Zero());
  }
}

void Assembler::lengthen(int first, int count, double factor) {
  evaluated_ = {};
  for (std::size_t i = 0; i < network_.elements.size(); ++i)
    if (const int element = network_.scene_element[i]; element >= first && element < first + count)
      network_.elements[i].length *= factor;
}

void Assembler::grip_bed(const GripPlaces& places) {
  std::get<BedTerm>(parts_->terms).grip(places);
  std::get<BedSpotTerm>(parts_->terms).grip(places);
}

void Assembler::begin(const Situation& situation, Vec x, Vec v) {
  const OpenVectors vectors(network_, parts_->outside, x, v, nullptr, nullptr);
  const NodeData& data = vectors.data;
  evaluated_ = {};
  parts_->exchange.begin(data.x, data.v, nullptr, data.outside, data.ghost_rotations);
  parts_->prescribed.place(situation, rule_.has_mean_acceleration(), data.outside);
  parts_->exchange.end();
  Evaluation evaluation{
      network_, data, situation, rule_, parts_->exchange, parts_->bodies(), parts_->bodies().carried()};
  parts_->bodies().start_step(data);
  for_each_term(parts_->terms, [&](auto& term) { term.begin_step(evaluation); });
  if (parts_->accounts) parts_->accounts->begin_step(evaluation);
  if (parts_->tensions) parts_->tensions->add(evaluation, std::get<CableTerm>(parts_->terms).reached());
}

void Assembler::begin_step(double t, Vec x, Vec v) {
  if (parts_->accounts) open_accounts(t, x, v);
  begin({.stage = {t, 0, 0}}, x, v);
}

bool Assembler::evaluate_terms(const Situation& situation, Vec x, Vec v, Vec a, Vec r, const TangentRequest* request,
                               bool must_exchange) {
  const OpenVectors vectors(network_, parts_->outside, x, v, a, r);
  const NodeData& data = vectors.data;
  Evaluation evaluation{
      network_, data, situation, rule_, parts_->exchange, parts_->bodies(), parts_->bodies().carried()};
  evaluation.has_rates = parts_->has_rates;
  evaluation.has_residual = r != nullptr;
  evaluation.is_exchanging = must_exchange;
  evaluation.target.elements = parts_->pattern.elements().data();
  if (must_exchange) {
    parts_->exchange.begin(data.x, data.v, data.a, data.outside, data.ghost_rotations);
    parts_->prescribed.place(situation, rule_.has_mean_acceleration(), data.outside);
  }
  if (request != nullptr) {
    evaluation.has_tangent = true;
    evaluation.target = {request->matrix.open(), evaluation.target.elements, request->shift,
                         request->holds_water,   request->steadiness,        request->turning};
    parts_->bodies().clear_blocks(evaluation.target);
  }
  for_each_term(parts_->terms, [&](auto& term) { term.add(evaluation); });
  if (request != nullptr) request->matrix.close();
  evaluation.complete();
  coincident_ = evaluation.coincident;
  return evaluation.in_domain;
}

bool Assembler::evaluate(const Situation& situation, Vec x, Vec v, Vec a, Vec r, const TangentRequest* request) {
  evaluated_ = {};
  return evaluate_terms(situation, x, v, a, r, request, true);
}

bool Assembler::residual(const Stage& stage, Vec x, Vec v, Vec a, Vec r, const TangentRequest* request) {
  evaluated_ = petsc::state_of(x);
  evaluated_stage_ = stage;
  parts_->last_residual = {x, v, a};
  return evaluate_terms({.stage = stage}, x, v, a, r, request, true);
}

void Assembler::tangent(const Stage& stage, Vec x, Vec v, Vec a, const TangentRequest& request) {
  const bool is_new = petsc::state_of(x) != evaluated_ || stage != evaluated_stage_;
  evaluated_ = petsc::state_of(x);
  evaluated_stage_ = stage;
  evaluate_terms({.stage = stage}, x, v, a, nullptr, &request, is_new);
}

void Assembler::mass_matrix(double t, Vec x, Vec v, TangentMatrix& mass) {
  const Vector resting = make_vector();
  const TangentRequest request{mass, {0, 0, 1}};
  evaluate({.stage = {t, 0, 0}, .internal = InternalForce::none}, x, v, resting, nullptr, &request);
}

void Assembler::force(double t, Vec x, Vec v, Vec force) {
  const Vector resting = make_vector();
  evaluate({.stage = {t, 0, 0}, .internal = InternalForce::of_instant}, x, v, resting, force, nullptr);
  check(VecScale(force, -1));
}

void Assembler::end_step(const Stage& stage, Vec x, Vec v) {
  parts_->prescribed.end_step(stage, parts_->outside.forces.data());
  {
    const petsc::ChangedValues at_x(x), at_v(v);
    const StepEnd end{stage, rule_.conserves(stage, network_.surroundings.fluid.has_value()), at_x, at_v};
    for_each_term(parts_->terms, [&](auto& term) { term.end_step(end); });
    if (parts_->accounts) parts_->accounts->end_step(end);
  }
  if (parts_->accounts) close_accounts(stage, x, v);
}

const LocalState& Assembler::observe(double t, Vec x, Vec v, Vec a, bool is_calm) {
  const OpenVectors vectors(network_, parts_->outside, x, v, a, nullptr);
  const NodeData& data = vectors.data;
  const Situation situation{.stage = {t, 0, 0}};
  evaluated_ = {};
  parts_->exchange.begin(data.x, data.v, data.a, data.outside, data.ghost_rotations);
  Evaluation evaluation{
      network_, data, situation, rule_, parts_->exchange, parts_->bodies(), parts_->bodies().carried()};
  evaluation.is_exchanging = true;
  evaluation.complete();
  const AnyNodes nodes{data};
  for (const auto& [node, motion] : network_.prescribed) nodes.outside(node) = motion.at(t);
  for (auto* field : {&state_.x, &state_.v, &state_.a}) field->resize(3 * at(network_.nodes));
  for (LocalNode node(0); node.value() < network_.nodes; ++node) {
    std::copy_n(nodes.x(node).data(), 3, state_.x.data() + 3 * at(node));
    std::copy_n(nodes.v(node).data(), 3, state_.v.data() + 3 * at(node));
    std::copy_n(nodes.a(node).data(), 3, state_.a.data() + 3 * at(node));
  }
  state_.t = t;
  state_.is_calm = is_calm;
  state_.bodies = parts_->bodies().states(data);
  return state_;
}

Energies Assembler::energies() const {
  Energies sum;
  sum.work = parts_->prescribed.work();
  for_each_term(parts_->terms, [&](const auto& term) { term.add_energy(state_, sum); });
  sum.start = sum.total();
  if (parts_->accounts) parts_->accounts->add_to(sum);
  return sum;
}

double Assembler::potential(const Situation& situation) const {
  double sum = 0;
  for_each_term(parts_->terms, [&](const auto& term) { term.add_potential(situation, state_, sum); });
  return sum;
}

Vector3 Assembler::end_force(int element, std::size_t end) const {
  Vector3 sum = Vector3::Zero();
  for_each_term(parts_->terms, [&](const auto& term) { sum += term.end_force(state_, element, end); });
  return sum;
}

Vector3 Assembler::node_force(LocalNode node) const {
  Vector3 sum = Vector3::Zero();
  for_each_term(parts_->terms, [&](const auto& term) { sum += term.node_force(state_, node); });
  return sum;
}

void Assembler::keep_tensions() { parts_->tensions = std::make_unique<TensionRecord>(network_); }

std::span<const ElementTension> Assembler::tensions() { return parts_->tensions->until(state_); }

/// Accelerations have no part in it.
ForceScales Assembler::force_scales(double t, Vec x, Vec v) {
  observe(t, x, v, v);
  ForceSums sums;
  for_each_term(parts_->terms, [&](const auto& term) { term.add_scales(state_, sums); });
  return ForceScales::of(sums, communicator_);
}

int Assembler::nearly_singular_body(Vec x) const {
  if (!network_.has_euler_bodies) return -1;
  int found = parts_->bodies().nearly_singular(OpenVectors(network_, parts_->outside, x, x, nullptr, nullptr).data);
  MPI_Allreduce(MPI_IN_PLACE, &found, 1, MPI_INT, MPI_MAX, communicator_);
  return found;
}

int Assembler::outside_body() const { return parts_->bodies().outside(); }

/// The work of constant forces counts from the network's start, which statics may have moved.
void Assembler::archive(Archive& archive) {
  archive.item("start", std::span(network_.position.data()->data(), 3 * network_.position.size()));
  for (int b = 0; b < network_.own_bodies; ++b)
    archive.item("start.attitude", std::span(network_.bodies[at(b)].start.y.data(), 4));
  parts_->prescribed.archive(archive);
  for_each_term(parts_->terms, [&](auto& term) { term.archive(archive); });
  if (parts_->accounts) parts_->accounts->archive(archive);
  if (parts_->looks) parts_->looks->archive(archive);
  if (parts_->tensions) parts_->tensions->archive(archive);
}

}   // namespace cablenet::system
