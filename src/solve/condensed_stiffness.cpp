#include "cablenet/solve/condensed_stiffness.hpp"

#include <algorithm>
#include <cmath>

#include "cablenet/bodies/small_turn.hpp"
#include "cablenet/partition/partition.hpp"
#include "cablenet/petsc/values.hpp"
#include "cablenet/solve/static_newton.hpp"

namespace cablenet::solve {
namespace {

using petsc::check;

/// What is added to a singular tangent's diagonal, over its largest value.  What drifts freely without pulling at
/// anything, as a chain that lies slack, then stays where it is.
constexpr double least_stiffness = 1e-12;

/// A solution whose residual is larger than this, over the right side, is none.
constexpr double solved = 1e-7;

/// The unknowns of a node in the numbering of PETSc's vectors.
struct Rows {
  PetscInt first = -1, count = 0;
};

double norm(Vec v) {
  PetscReal value = 0;
  check(VecNorm(v, NORM_2, &value));
  return value;
}

/// Nodes that the scene holds or moves become free, where they stand.
network::Network released(network::Network network, const std::vector<SceneNode>& nodes) {
  const auto is_asked = [&](const network::PrescribedNode& held) {
    return std::find(nodes.begin(), nodes.end(), held.node) != nodes.end();
  };
  auto& held = network.prescribed;
  held.erase(std::remove_if(held.begin(), held.end(), is_asked), held.end());
  return network;
}

std::vector<SceneNode> held_among(const network::Network& network, const std::vector<SceneNode>& nodes) {
  std::vector<SceneNode> found;
  for (const network::PrescribedNode& held : network.prescribed)
    if (std::find(nodes.begin(), nodes.end(), held.node) != nodes.end()) found.push_back(held.node);
  return found;
}

Rows rows_of(const system::Assembler& assembler, Vec like, SceneNode node) {
  const partition::LocalNetwork& here = assembler.network();
  PetscInt begin = 0;
  check(VecGetOwnershipRange(like, &begin, nullptr));
  int found[2] = {-1, 0};
  for (LocalNode local(0); here.is_owned(local); ++local) {
    if (here.scene_node[local] != node) continue;
    found[0] = begin + here.begin[local].value();
    found[1] = here.begin[local + 1].value() - here.begin[local].value();
  }
  MPI_Allreduce(MPI_IN_PLACE, found, 2, MPI_INT, MPI_MAX, assembler.communicator());
  return {found[0], found[1]};
}

/// The columns are the motion of a body's unknowns as it is displaced and turned.
CondensedStiffness::Matrix motions_of(const network::Body& body, PetscInt unknowns) {
  CondensedStiffness::Matrix motions = CondensedStiffness::Matrix::Zero(unknowns, 6);
  motions.topLeftCorner<3, 3>().setIdentity();
  motions.bottomRightCorner(unknowns - 3, 3) = bodies::small_turn(body.properties, body.start.y).topRows(unknowns - 3);
  return motions;
}

}   // namespace

network::Network at_start_of(network::Network network, const system::Assembler& assembler) {
  const partition::LocalNetwork& here = assembler.network();
  Table<SceneNode, Vector3> position(network.position.size(), Vector3::Zero());
  std::vector<bodies::Vector4> attitude(network.bodies.size(), bodies::Vector4::Zero());
  for (LocalNode node(0); node.value() < here.nodes; ++node)
    if (here.primary[node]) position[here.scene_node[node]] = here.position[node];
  for (std::size_t b = 0; b < at(here.own_bodies); ++b) attitude[at(here.bodies[b].body)] = here.bodies[b].start.y;
  const auto add_up = [&](double* values, int count) {
    MPI_Allreduce(MPI_IN_PLACE, values, count, MPI_DOUBLE, MPI_SUM, assembler.communicator());
  };
  if (!position.empty()) add_up(position.data()->data(), 3 * position.size());
  if (!attitude.empty()) add_up(attitude.data()->data(), static_cast<int>(4 * attitude.size()));
  network.position = std::move(position);
  for (std::size_t b = 0; b < attitude.size(); ++b) {
    network.bodies[b].start = {};
    network.bodies[b].start.y = attitude[b];
  }
  return network;
}

struct CondensedStiffness::Parts {
  Parts(network::Network standing, const std::vector<SceneNode>& asked, const system::ForceRule& rule, double t,
        const Vector3& velocity, MPI_Comm communicator)
      : held(held_among(standing, asked)),
        network(released(std::move(standing), asked)),
        partition(partition::make_partition(network, communicator)),
        assembler(partition::make_local_network(network, partition, rank_of(communicator)), rule, communicator),
        forces(assembler, t, velocity),
        tangent(assembler.make_tangent()) {
    for (auto* vector : {&x, &scratch, &right, &motion, &reaction}) *vector = assembler.make_vector();
    assembler.fill_initial(x, scratch);
    forces.keep(x);
    forces.residual({system::StaticRule::Kind::exact}, x, scratch, &tangent, {});
    check(MatDuplicate(tangent.matrix(), MAT_COPY_VALUES, whole.out()));
    check(MatSetOption(tangent.matrix(), MAT_KEEP_NONZERO_PATTERN, PETSC_TRUE));
    check(MatNorm(whole, NORM_INFINITY, &largest));
    check(KSPCreate(communicator, ksp.out()));
    linear = LinearSolver(ksp, assembler.network(), tangent.matrix());
  }

  static int rank_of(MPI_Comm communicator) {
    int rank = 0;
    MPI_Comm_rank(communicator, &rank);
    return rank;
  }

  bool is_mine(PetscInt row) const {
    PetscInt begin = 0, end = 0;
    check(VecGetOwnershipRange(x, &begin, &end));
    return row >= begin && row < end;
  }

  /// The rows on this rank of the node and of all nodes that the scene holds.
  std::vector<PetscInt> fixed_rows(SceneNode node) const {
    std::vector<PetscInt> rows;
    const auto add = [&](SceneNode one) {
      const Rows of = rows_of(assembler, x, one);
      for (PetscInt i = 0; i < of.count; ++i)
        if (is_mine(of.first + i)) rows.push_back(of.first + i);
    };
    add(node);
    for (const SceneNode one : held)
      if (one != node) add(one);
    return rows;
  }

  /// What holds these unknowns leaves of the tangent.
  void hold(const std::vector<PetscInt>& rows, double more) {
    Mat matrix = tangent.matrix();
    check(MatCopy(whole, matrix, SAME_NONZERO_PATTERN));
    if (more > 0) check(MatShift(matrix, more));
    check(MatZeroRowsColumns(matrix, static_cast<PetscInt>(rows.size()), rows.data(), largest, nullptr, nullptr));
  }

  /// motion = how everything moves when unknown j does by 1.  @returns false where that is not defined
  bool follow(PetscInt j, const std::vector<PetscInt>& fixed) {
    const std::vector<double> none(fixed.size(), 0);
    const auto clear = [&](Vec v) {
      check(VecSetValues(v, static_cast<PetscInt>(fixed.size()), fixed.data(), none.data(), INSERT_VALUES));
      check(VecAssemblyBegin(v));
      check(VecAssemblyEnd(v));
    };
    check(VecSet(scratch, 0));
    if (is_mine(j)) check(VecSetValue(scratch, j, -1, INSERT_VALUES));
    check(VecAssemblyBegin(scratch));
    check(VecAssemblyEnd(scratch));
    check(MatMult(whole, scratch, right));
    clear(right);
    check(KSPSolve(ksp, right, motion));
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    check(KSPGetConvergedReason(ksp, &reason));
    if (reason < 0) linear.recover();
    check(MatMult(tangent.matrix(), motion, reaction));
    check(VecAXPY(reaction, -1, right));
    const double size = norm(right), miss = norm(reaction);
    if (reason < 0 || !std::isfinite(norm(motion)) || miss > solved * size) return false;
    check(VecAXPY(motion, -1, scratch));
    return true;
  }

  std::vector<SceneNode> held;   ///< asked for, and held or moved by the scene
  network::Network network;
  partition::Partition partition;
  system::Assembler assembler;
  StaticForces forces;
  system::TangentMatrix tangent;
  system::Matrix whole;   ///< the tangent of all that is free here
  PetscReal largest = 0;
  KrylovSolver ksp;
  LinearSolver linear;
  system::Vector x, scratch, right, motion, reaction;
};

CondensedStiffness::CondensedStiffness(network::Network standing, const std::vector<SceneNode>& asked,
                                       const system::ForceRule& rule, double t, const Vector3& velocity,
                                       MPI_Comm communicator)
    : parts_(std::make_unique<Parts>(std::move(standing), asked, rule, t, velocity, communicator)) {}

CondensedStiffness::~CondensedStiffness() = default;

std::optional<CondensedStiffness::Matrix> CondensedStiffness::of(SceneNode node) {
  Parts& p = *parts_;
  const Rows rows = rows_of(p.assembler, p.x, node);
  const std::vector<PetscInt> fixed = p.fixed_rows(node);
  for (const double more : {0.0, least_stiffness * p.largest}) {
    p.hold(fixed, more);
    Matrix K = Matrix::Zero(rows.count, rows.count);
    bool is_defined = true;
    for (PetscInt j = 0; j < rows.count && is_defined; ++j) {
      is_defined = p.follow(rows.first + j, fixed);
      check(MatMult(p.whole, p.motion, p.reaction));
      const petsc::ReadValues values(p.reaction);
      PetscInt begin = 0;
      check(VecGetOwnershipRange(p.reaction, &begin, nullptr));
      for (PetscInt i = 0; i < rows.count; ++i)
        if (p.is_mine(rows.first + i)) K(i, j) = values[rows.first + i - begin];
    }
    if (!is_defined) continue;
    MPI_Allreduce(MPI_IN_PLACE, K.data(), static_cast<int>(K.size()), MPI_DOUBLE, MPI_SUM, p.assembler.communicator());
    const auto body = std::find_if(p.network.bodies.begin(), p.network.bodies.end(),
                                   [&](const network::Body& one) { return one.node == node; });
    if (rows.count == 3 || body == p.network.bodies.end()) return K;
    const Matrix motions = motions_of(*body, rows.count);
    return motions.transpose() * K * motions;
  }
  return {};
}

}   // namespace cablenet::solve
