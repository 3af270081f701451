#include "cablenet/system/assembler.hpp"

#include <algorithm>

#include "element_loop.hpp"
#include "force_laws.hpp"

namespace cablenet::system {
namespace {

using petsc::check;

std::size_t at(int index) { return static_cast<std::size_t>(index); }

}   // namespace

Assembler::Assembler(partition::LocalNetwork network, ForceRule rule, MPI_Comm communicator)
    : network_(std::move(network)), rule_(rule), communicator_(communicator) {
  const std::size_t values = 3 * at(network_.nodes);
  for (auto* field : {&state_.x, &state_.v, &state_.a, &r_}) field->assign(values, 0);
  start_.resize(network_.elements.size());
  prescribed_.resize(network_.prescribed.size());
  for (std::size_t i = 0; i < network_.position.size(); ++i) {
    LocalState::at(state_.x, static_cast<int>(i)) = network_.position[i];
    LocalState::at(state_.v, static_cast<int>(i)) = network_.velocity[i];
  }
  std::vector<PetscInt> blocks;
  for (int i = 0; i < network_.owned + network_.ghosts; ++i) blocks.push_back(network_.number(i));
  petsc::Handle<IS, ISDestroy> from;
  const PetscInt count = static_cast<PetscInt>(blocks.size());
  check(ISCreateBlock(communicator_, 3, count, blocks.data(), PETSC_COPY_VALUES, from.out()));
  check(VecCreateSeqWithArray(PETSC_COMM_SELF, 3, 3 * count, nullptr, local_view_.out()));
  const Vector global = make_vector();
  check(VecScatterCreate(global, from, local_view_, nullptr, ghosts_.out()));
}

Vector Assembler::make_vector() const {
  Vector vector;
  check(VecCreate(communicator_, vector.out()));
  check(VecSetSizes(vector, 3 * network_.owned, 3 * network_.free_nodes));
  check(VecSetBlockSize(vector, 3));
  check(VecSetFromOptions(vector));
  return vector;
}

Matrix Assembler::make_matrix() {
  Matrix matrix;
  check(MatCreate(communicator_, matrix.out()));
  check(MatSetSizes(matrix, 3 * network_.owned, 3 * network_.owned, 3 * network_.free_nodes, 3 * network_.free_nodes));
  check(MatSetBlockSize(matrix, 3));
  check(MatSetType(matrix, MATAIJ));
  check(MatSetFromOptions(matrix));
  std::vector<PetscInt> rows, columns;
  const auto dof = [&](int node, int k) {
    return network_.is_free(node) ? static_cast<PetscInt>(3 * network_.number(node) + k) : PetscInt{-1};
  };
  for_each_element(network_, [&](std::size_t, const partition::LocalElement& e) {
    for (int row = 0; row < 6; ++row)
      for (int column = 0; column < 6; ++column) {
        const PetscInt i = dof(e.node[at(row / 3)], row % 3);
        const PetscInt j = dof(e.node[at(column / 3)], column % 3);
        rows.push_back(i < 0 || j < 0 ? -1 : i);
        columns.push_back(i < 0 || j < 0 ? -1 : j);
      }
    return true;
  });
  for (const auto& load : network_.loads)
    for (int k = 0; k < 3; ++k) rows.push_back(dof(load.node, k)), columns.push_back(dof(load.node, k));
  tangent_.resize(rows.size());
  check(MatSetPreallocationCOO(matrix, static_cast<PetscCount>(rows.size()), rows.data(), columns.data()));
  return matrix;
}

void Assembler::fill_initial(Vec x, Vec v) const {
  for (const auto& [vector, values] : {std::pair{x, &network_.position}, std::pair{v, &network_.velocity}}) {
    double* array = nullptr;
    check(VecGetArrayWrite(vector, &array));
    for (int i = 0; i < network_.owned; ++i) Eigen::Map<Vector3>(array + 3 * i) = (*values)[at(i)];
    check(VecRestoreArrayWrite(vector, &array));
  }
}

void Assembler::scatter(Vec global, std::vector<double>& local) const {
  check(VecPlaceArray(local_view_, local.data()));
  check(VecScatterBegin(ghosts_, global, local_view_, INSERT_VALUES, SCATTER_FORWARD));
  check(VecScatterEnd(ghosts_, global, local_view_, INSERT_VALUES, SCATTER_FORWARD));
  check(VecResetArray(local_view_));
}

void Assembler::add_to_owners(Vec global) {
  check(VecZeroEntries(global));
  check(VecPlaceArray(local_view_, r_.data()));
  check(VecScatterBegin(ghosts_, local_view_, global, ADD_VALUES, SCATTER_REVERSE));
  check(VecScatterEnd(ghosts_, local_view_, global, ADD_VALUES, SCATTER_REVERSE));
  check(VecResetArray(local_view_));
}

void Assembler::set_prescribed(const Stage& s) {
  const bool new_end = s.dt != prescribed_dt_;
  const bool midpoint = rule_.scheme == scene::Scheme::energy_momentum;
  prescribed_dt_ = s.dt;
  for (std::size_t i = 0; i < prescribed_.size(); ++i) {
    NodeStep& step = prescribed_[i];
    const auto& [node, motion] = network_.prescribed[i];
    if (new_end) step.end = motion.at(s.t + s.dt);
    const auto& [x0, v0, a0] = step.start;
    const auto& [x1, v1, a1] = step.end;
    LocalState::at(state_.x, node) = x0 + s.alpha_f * (x1 - x0);
    LocalState::at(state_.v, node) = v0 + s.alpha_f * (v1 - v0);
    // The free nodes' a_a stands for the stage's time t + alpha_f dt.  With the mid-point rule it is (v1 - v0)/dt:
    // taken alike here, the energy of fixed and uniformly moved points balances exactly.
    LocalState::at(state_.a, node) =
        midpoint && s.dt > 0 ? Vector3((v1 - v0) / s.dt) : Vector3(a0 + s.alpha_f * (a1 - a0));
  }
}

template <class Visit>
void Assembler::visit_law(const Stage& stage, Visit&& visit) const {
  switch (rule_.scheme) {
    case scene::Scheme::energy_momentum:
      return visit(EnergyMomentumLaw{rule_.tangent, stage.alpha_f, stage.dt, rule_.axial_dissipation});
    case scene::Scheme::generalized_alpha:
      return visit(AveragedLaw{rule_.tangent, stage.alpha_f});
    case scene::Scheme::plain:
      return visit(StageLaw{rule_.tangent});
  }
}

template <class Law>
bool Assembler::add_residual(const Law& law) {
  std::fill(r_.begin(), r_.end(), 0.0);
  return for_each_element(network_, [&](std::size_t i, const partition::LocalElement& e) {
    const elements::CableMaterial& material = network_.materials[at(e.material)];
    const elements::Chord chord = state_.chord(e);
    const ElementStep step{material, e.length, chord, start_[i].chord, start_[i].force};
    if (!law.in_domain(step)) {
      coincident_ = network_.scene_element[i];
      return false;
    }
    const elements::EndForces q = state_.inertial(e, material.mass_damping);
    const elements::EndForces inertia = elements::cable_inertia(material, e.length, q.on1, q.on2);
    const Vector3 half_weight(0, 0, -0.5 * material.mass_per_length * e.length * network_.gravity);
    const Vector3 f = law.force(step);
    LocalState::at(r_, e.node[0]) += inertia.on1 - f - half_weight;
    LocalState::at(r_, e.node[1]) += inertia.on2 + f - half_weight;
    return true;
  });
}

void Assembler::add_load_residual() {
  for (const auto& [node, mass, force] : network_.loads)
    LocalState::at(r_, node) += mass * (LocalState::at(state_.a, node) + Vector3(0, 0, network_.gravity)) - force;
}

void Assembler::start_prescribed(double t) {
  prescribed_dt_ = -1;
  for (std::size_t i = 0; i < prescribed_.size(); ++i) prescribed_[i].start = network_.prescribed[i].motion.at(t);
}

void Assembler::begin_step(double t, Vec x, Vec v) {
  scatter(x, state_.x);
  scatter(v, state_.v);
  start_prescribed(t);
  for (std::size_t i = 0; i < prescribed_.size(); ++i) {
    LocalState::at(state_.x, network_.prescribed[i].node) = prescribed_[i].start.x;
    LocalState::at(state_.v, network_.prescribed[i].node) = prescribed_[i].start.v;
  }
  const bool needs_force = rule_.scheme == scene::Scheme::generalized_alpha;
  for_each_element(network_, [&](std::size_t i, const partition::LocalElement& e) {
    start_[i].chord = state_.chord(e);
    if (needs_force)
      start_[i].force = elements::cable_force(network_.materials[at(e.material)], e.length, start_[i].chord);
    return true;
  });
}

bool Assembler::residual(const Stage& stage, Vec x, Vec v, Vec a, Vec r) {
  coincident_ = -1;
  set_prescribed(stage);
  scatter(x, state_.x);
  scatter(v, state_.v);
  scatter(a, state_.a);
  bool in_domain = true;
  visit_law(stage, [&](const auto& law) { in_domain = add_residual(law); });
  add_load_residual();
  add_to_owners(r);
  return in_domain;
}

template <class Law>
void Assembler::add_tangent(const Law& law, double shift_v, double shift_a, Mat matrix) {
  using Block = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
  for_each_element(network_, [&](std::size_t i, const partition::LocalElement& e) {
    const elements::CableMaterial& material = network_.materials[at(e.material)];
    const elements::Chord chord = state_.chord(e);
    const ElementStep step{material, e.length, chord, start_[i].chord, start_[i].force};
    const Matrix3 K = law.tangent(step, shift_v);
    const double m = material.mass_per_length * e.length / 6 * (shift_a + material.mass_damping * shift_v);
    Eigen::Map<Block> block(tangent_.data() + 36 * i);
    block.topLeftCorner<3, 3>() = K + 2 * m * Matrix3::Identity();
    block.bottomRightCorner<3, 3>() = block.topLeftCorner<3, 3>();
    block.topRightCorner<3, 3>() = m * Matrix3::Identity() - K;
    block.bottomLeftCorner<3, 3>() = block.topRightCorner<3, 3>();
    return true;
  });
  double* tail = tangent_.data() + 36 * network_.elements.size();
  for (const auto& load : network_.loads) tail = std::fill_n(tail, 3, load.mass * shift_a);
  check(MatSetValuesCOO(matrix, tangent_.data(), INSERT_VALUES));
}

void Assembler::jacobian(const Stage& stage, double shift_v, double shift_a, Mat matrix) {
  visit_law(stage, [&](const auto& law) { add_tangent(law, shift_v, shift_a, matrix); });
}

void Assembler::mass_matrix(Mat mass) { add_tangent(NoLaw{}, 0, 1, mass); }

void Assembler::scaled_identity(double s, Mat matrix) {
  std::fill(tangent_.begin(), tangent_.end(), 0.0);
  check(MatSetValuesCOO(matrix, tangent_.data(), INSERT_VALUES));
  check(MatShift(matrix, s));
}

void Assembler::force(double t, Vec x, Vec v, Vec force) {
  start_prescribed(t);
  set_prescribed({t, 0, 0});
  scatter(x, state_.x);
  scatter(v, state_.v);
  std::fill_n(state_.a.begin(), 3 * at(network_.owned + network_.ghosts), 0.0);
  add_residual(StageLaw{rule_.tangent});
  add_load_residual();
  add_to_owners(force);
  check(VecScale(force, -1));
}

void Assembler::add_work(const Stage& s) {
  const double stage_t = s.t + s.alpha_f * s.dt;
  const double lag = s.t + 0.5 * s.dt - stage_t;
  // The reaction is known at the stage; work wants it at mid-step.
  const double slope = previous_stage_t_ < stage_t && lag != 0 ? lag / (stage_t - previous_stage_t_) : 0;
  for (std::size_t i = 0; i < prescribed_.size(); ++i) {
    NodeStep& step = prescribed_[i];
    const Vector3 reaction = LocalState::at(r_, network_.prescribed[i].node);
    const bool first = step.previous_reaction.isZero(0);
    const Vector3 middle = first ? reaction : Vector3(reaction + slope * (reaction - step.previous_reaction));
    work_ += middle.dot(step.end.x - step.start.x);
    step.previous_reaction = reaction;
  }
  previous_stage_t_ = stage_t;
}

}   // namespace cablenet::system
