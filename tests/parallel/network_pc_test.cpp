#include "cablenet/solve/network_pc.hpp"

#include <gtest/gtest.h>
#include <petscksp.h>

#include "../support/networks.hpp"
#include "../support/scenes.hpp"

using namespace cablenet;
using namespace cablenet::test;
using scene::Scheme;

namespace {

constexpr double any_work = 1e9;

/// A tangent of a disturbed network and a solver for it.
class Problem {
public:
  Problem(const network::Network& network, Scheme scheme, double dt = 0.02)
      : system_(network, {scheme, 0, elements::Tangent::exact}, PETSC_COMM_WORLD),
        tangent_(system_.assembler.make_tangent()) {
    const Field zero(network.position.size(), Vector3::Zero());
    const system::Stage stage{0, dt, 0.5};
    system_.assembler.begin_step(0, system_.vector(disturbed(network.position, 0.02, 1)), system_.vector(zero));
    system_.assembler.tangent(stage, system_.vector(disturbed(network.position, 0.02, 500)), system_.vector(zero),
                              system_.vector(zero), {tangent_, {1, 2 / dt, 4 / (dt * dt)}});
    tangent_.publish();
    pc_ = solve::NetworkPc::make(system_.assembler.network(), tangent_.matrix(), any_work);
    petsc::check(KSPCreate(PETSC_COMM_WORLD, ksp_.out()));
    petsc::check(KSPSetType(ksp_, KSPPREONLY));
    petsc::check(KSPSetOperators(ksp_, tangent_.matrix(), tangent_.matrix()));
    PC pc = nullptr;
    petsc::check(KSPGetPC(ksp_, &pc));
    pc_->attach(pc);
  }

  /// |b - A x| / |b|
  double relative_residual(int seed = 7) {
    const Field zero(system_.network.position.size(), Vector3::Zero());
    const system::Vector b = system_.vector(disturbed(zero, 1, seed)), x = system_.assembler.make_vector();
    petsc::check(KSPSolve(ksp_, b, x));
    PetscReal size = 0, error = 0;
    petsc::check(VecNorm(b, NORM_2, &size));
    const system::Vector r = system_.assembler.make_vector();
    petsc::check(MatMult(tangent_.matrix(), x, r));
    petsc::check(VecAXPY(r, -1, b));
    petsc::check(VecNorm(r, NORM_2, &error));
    return error / size;
  }
  KSPConvergedReason reason() const {
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    petsc::check(KSPGetConvergedReason(ksp_, &reason));
    return reason;
  }
  PetscInt iterations() const {
    PetscInt count = 0;
    petsc::check(KSPGetIterationNumber(ksp_, &count));
    return count;
  }
  void use_gmres() { petsc::check(KSPSetType(ksp_, KSPGMRES)); }
  void use_lu() {
    PC pc = nullptr;
    petsc::check(KSPGetPC(ksp_, &pc));
    petsc::check(PCSetType(pc, PCLU));
  }

  Mat matrix() const { return tangent_.matrix(); }
  system::TangentMatrix& tangent() { return tangent_; }
  const System& system() const { return system_; }
  const solve::NetworkPc& pc() const { return *pc_; }

private:
  System system_;
  system::TangentMatrix tangent_;
  std::unique_ptr<solve::NetworkPc> pc_;
  petsc::Handle<KSP, KSPDestroy> ksp_;
};

/// Leaves `diagonal` alone in a node's rows and columns.
void zero_node(const Problem& problem, PetscInt node, double diagonal) {
  const PetscInt rows[] = {3 * node, 3 * node + 1, 3 * node + 2};
  petsc::check(MatZeroRowsColumns(problem.matrix(), 3, rows, diagonal, nullptr, nullptr));
}

class NetworkPcOf : public testing::TestWithParam<std::tuple<NamedScene, Scheme>> {};

const std::string loops = R"(
points: {a: {position: [0, 0, 0], motion: fixed}, b: {position: [20, 0, 0], mass: 2}, c: {position: [9, 9, 0]}}
cables:
  ab: {type: rope, from: a, to: b, elements: 20}
  bc: {type: rope, from: b, to: c, elements: 12}
  ca: {type: rope, from: c, to: {cable: ab, at: 4}, elements: 11}
  stay: {type: rope, from: {cable: bc, at: 6}, to: {cable: ab, at: 9}, elements: 7}
)";

std::vector<NamedScene> scenes() {
  std::vector<NamedScene> all = kinds_of_networks;
  all.push_back({"loops", loops});
  return all;
}

/// An array of elements of 1 m, with EA/L = 1e9 N/m and nodes of 1 kg.
network::Network stiff_array() {
  network::Network network = network_of(array);
  for (auto& material : network.materials) {
    material.axial_stiffness = 1e9;
    material.mass_per_length = 1;
  }
  return network;
}

}   // namespace

TEST_P(NetworkPcOf, SolvesExactlyInOneIteration) {
  const auto& [named, scheme] = GetParam();
  Problem problem(network_of(named.text), scheme);
  EXPECT_LE(problem.relative_residual(), 1e-13);
  EXPECT_EQ(problem.iterations(), 1);
  EXPECT_LE(problem.relative_residual(70), 1e-13) << "another right-hand side, the same factors";
  problem.tangent().set_identity(4);
  EXPECT_LE(problem.relative_residual(), 1e-15) << "another matrix of the same pattern";
  EXPECT_EQ(problem.pc().pivots().singular_node, SolverNumber());
  EXPECT_EQ(problem.pc().pivots().negative, 0);
}

TEST_P(NetworkPcOf, PreconditionsAnyKrylovMethod) {
  const auto& [named, scheme] = GetParam();
  Problem problem(network_of(named.text), scheme);
  problem.use_gmres();
  EXPECT_LE(problem.relative_residual(), 1e-12);
  EXPECT_EQ(problem.iterations(), 1);
}

INSTANTIATE_TEST_SUITE_P(Scenes, NetworkPcOf,
                         testing::Combine(testing::ValuesIn(scenes()),
                                          testing::Values(Scheme::energy_momentum, Scheme::plain)),
                         [](const auto& item) {
                           const bool plain = std::get<1>(item.param) == Scheme::plain;
                           return std::get<0>(item.param).name + (plain ? "_symmetric" : "");
                         });

/// At the longer step no method can leave less than eps |A| |x|, some 1e-12 |b|.
TEST(NetworkPc, KeepsItsDigitsOnStiffCables) {
  for (const Scheme scheme : {Scheme::energy_momentum, Scheme::plain}) {
    EXPECT_LE(Problem(stiff_array(), scheme, 1e-3).relative_residual(), 1e-12);
    Problem problem(stiff_array(), scheme, 1e-2);
    const double ours = problem.relative_residual();
    problem.use_lu();
    EXPECT_LE(ours, 2 * problem.relative_residual());
  }
}

TEST(NetworkPc, NamesTheNodeWhereTheMatrixIsSingular) {
  for (const std::string& text : {array, net, two_cables})
    for (const Scheme scheme : {Scheme::energy_momentum, Scheme::plain}) {
      Problem problem(network_of(text), scheme);
      const PetscInt node = problem.system().assembler.network().free_nodes / 2;
      zero_node(problem, node, 0);
      problem.relative_residual();
      EXPECT_EQ(problem.reason(), KSP_DIVERGED_PC_FAILED);
      EXPECT_EQ(problem.pc().pivots().singular_node, SolverNumber(node));
      EXPECT_FALSE(std::isfinite(problem.relative_residual()));
      problem.tangent().set_identity(1);
      EXPECT_LE(problem.relative_residual(), 1e-15) << "a regular matrix after a singular one";
      EXPECT_GT(problem.reason(), 0);
    }
}

TEST(NetworkPc, CountsNegativePivots) {
  Problem problem(network_of(loops), Scheme::plain);
  problem.tangent().set_identity(-1);
  problem.relative_residual();
  EXPECT_EQ(problem.pc().pivots().negative, 3 * problem.system().assembler.network().free_nodes);
}

/// Nodes that ranks share are solved for apart, from the sum of what all ranks leave there.
TEST(NetworkPc, CountsAndNamesPivotsOfTheInterface) {
  for (const std::string& text : {loops, array, net})
    for (const Scheme scheme : {Scheme::energy_momentum, Scheme::plain}) {
      Problem problem(network_of(text), scheme);
      const std::vector<SolverNumber> shared = problem.system().partition.interface.number;
      EXPECT_EQ(shared.empty(), size_of(PETSC_COMM_WORLD) == 1);
      for (const SolverNumber node : shared) {
        problem.tangent().set_identity(1);
        zero_node(problem, node.value(), -1);
        problem.relative_residual();
        EXPECT_EQ(problem.pc().pivots().negative, 3) << "node " << node.value();
        zero_node(problem, node.value(), 0);
        problem.relative_residual();
        EXPECT_EQ(problem.reason(), KSP_DIVERGED_PC_FAILED);
        EXPECT_EQ(problem.pc().pivots().singular_node, node);
      }
    }
}

TEST(NetworkPc, IsRefusedWhereItWouldTakeTooMuchWork) {
  const network::Network grid = network_of(net);
  Problem problem(grid, Scheme::plain);
  EXPECT_GT(problem.pc().updates_per_node(), 1);
  EXPECT_EQ(solve::NetworkPc::make(problem.system().assembler.network(), problem.matrix(), 0.5), nullptr);
  const int ranks = size_of(PETSC_COMM_WORLD);
  EXPECT_LE(Problem(network_of(chain), Scheme::plain).pc().updates_per_node(), ranks == 1 ? 1 : 5);
}
