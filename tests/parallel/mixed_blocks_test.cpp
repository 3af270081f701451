#include <gtest/gtest.h>
#include <petscksp.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "../support/networks.hpp"
#include "../support/scenes.hpp"
#include "cablenet/solve/network_pc.hpp"

/// These tests treat nodes of a network as bodies, whose blocks have 6 or 7 unknowns.
using namespace cablenet;
using namespace cablenet::test;
using partition::LocalNetwork;

namespace {

constexpr double any_work = 1e9;

using Matrix = petsc::Handle<Mat, MatDestroy>;
using Vector = petsc::Handle<Vec, VecDestroy>;

/// The number of unknowns of a block, by its solver number and by whether it belongs to the interface.
using Rule = std::function<int(int number, bool shared)>;

LocalNetwork local_network(const network::Network& network, const Rule& rule) {
  const partition::Partition partition = partition::make_partition(network, PETSC_COMM_WORLD);
  LocalNetwork local = partition::make_local_network(network, partition, rank_of(PETSC_COMM_WORLD));
  const std::vector<SolverNumber>& shared = partition.interface.number;
  std::vector<std::pair<SolverNumber, int>> large;
  for (SolverNumber i(0); i.value() < local.free_nodes; ++i)
    if (const int size = rule(i.value(), std::find(shared.begin(), shared.end(), i) != shared.end()); size != 3)
      large.emplace_back(i, size);
  local.blocks = partition::Blocks(local.free_nodes, large);
  return local;
}

/// The blocks are not symmetric.  The large entries of a body's block are on the other diagonal, so that its rows have
/// to be exchanged.
void add_block(Mat matrix, const partition::Blocks& blocks, SolverNumber i, SolverNumber j) {
  const int rows = blocks.size(i), columns = blocks.size(j);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const bool large = i == j && c == (rows == 3 ? r : rows - 1 - r);
      const double value = noise(7 * (61 * i.value() + j.value()) + 49 * r + c) / 2 + (large ? 9 : 0);
      petsc::check(MatSetValue(matrix, blocks.begin(i) + r, blocks.begin(j) + c, value, INSERT_VALUES));
    }
}

Matrix matrix_of(const LocalNetwork& network) {
  constexpr int most_in_row = 80;
  const partition::Blocks& blocks = network.blocks;
  const int rows = blocks.begin(network.first_number + network.owned) - blocks.begin(network.first_number);
  Matrix matrix;
  petsc::check(MatCreateAIJ(PETSC_COMM_WORLD, rows, rows, PETSC_DETERMINE, PETSC_DETERMINE, most_in_row, nullptr,
                            most_in_row, nullptr, matrix.out()));
  for (LocalNode node(0); network.is_owned(node); ++node)
    add_block(matrix, blocks, network.number(node), network.number(node));
  for (const auto& element : network.elements) {
    const auto [a, b] = element.node;
    if (!network.is_free(a) || !network.is_free(b)) continue;
    if (network.is_owned(a)) add_block(matrix, blocks, network.number(a), network.number(b));
    if (network.is_owned(b)) add_block(matrix, blocks, network.number(b), network.number(a));
  }
  petsc::check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  petsc::check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
  return matrix;
}

class Problem {
public:
  Problem(const network::Network& network, const Rule& rule, bool flagged_symmetric = false)
      : local(local_network(network, rule)), matrix(matrix_of(local)) {
    petsc::check(MatSetOption(matrix, MAT_SYMMETRIC, flagged_symmetric ? PETSC_TRUE : PETSC_FALSE));
    pc = solve::NetworkPc::make(local, matrix, any_work);
    petsc::check(KSPCreate(PETSC_COMM_WORLD, ksp_.out()));
    petsc::check(KSPSetType(ksp_, KSPPREONLY));
    PC shell = nullptr;
    petsc::check(KSPGetPC(ksp_, &shell));
    pc->attach(shell);
  }

  /// The relative error |x - y| / |y| of the solution x of A x = A y.
  double error(int seed = 3) {
    petsc::check(KSPSetOperators(ksp_, matrix, matrix));
    Vector exact, b, x;
    petsc::check(MatCreateVecs(matrix, exact.out(), b.out()));
    petsc::check(VecDuplicate(b, x.out()));
    PetscInt begin = 0, end = 0;
    petsc::check(VecGetOwnershipRange(exact, &begin, &end));
    for (PetscInt i = begin; i < end; ++i)
      petsc::check(VecSetValue(exact, i, noise(seed + static_cast<int>(i)), INSERT_VALUES));
    petsc::check(VecAssemblyBegin(exact));
    petsc::check(VecAssemblyEnd(exact));
    petsc::check(MatMult(matrix, exact, b));
    petsc::check(KSPSolve(ksp_, b, x));
    PetscReal size = 0, error = 0;
    petsc::check(VecNorm(exact, NORM_2, &size));
    petsc::check(VecAXPY(x, -1, exact));
    petsc::check(VecNorm(x, NORM_2, &error));
    return error / size;
  }

  LocalNetwork local;
  Matrix matrix;
  std::unique_ptr<solve::NetworkPc> pc;

private:
  petsc::Handle<KSP, KSPDestroy> ksp_;
};

struct NamedRule {
  std::string name;
  Rule rule;
};

const std::vector<NamedRule> rules{
    {"nodes_only", [](int, bool) { return 3; }},
    {"scattered", [](int i, bool) { return i % 4 == 1   ? 7
                                           : i % 7 == 3 ? 6
                                                        : 3; }},
    {"in_the_interior", [](int i, bool shared) { return !shared && i % 3 == 0 ? 7 : 3; }},
    {"on_the_interface", [](int i, bool shared) { return shared ? 6 + i % 2 : 3; }},
    {"side_by_side", [](int i, bool) { return i % 10 < 6 ? 7 - i % 2 : 3; }},
    {"bodies_only", [](int i, bool) { return 6 + i % 2; }},
    {"first_of_all", [](int i, bool) { return i == 0 ? 7 : 3; }},
};

class MixedBlocks : public testing::TestWithParam<std::tuple<NamedScene, NamedRule>> {};

}   // namespace

TEST_P(MixedBlocks, AreSolvedExactly) {
  const auto& [scene, named] = GetParam();
  Problem problem(network_of(scene.text), named.rule);
  EXPECT_LE(problem.error(), 1e-13);
  EXPECT_LE(problem.error(300), 1e-13) << "another right-hand side, the same factors";
  petsc::check(MatScale(problem.matrix, -3));
  EXPECT_LE(problem.error(), 1e-13) << "another matrix of the same pattern";
  EXPECT_EQ(problem.pc->pivots().singular_node, SolverNumber());
}

/// A symmetric factorisation reads only half of the matrix and would give a wrong solution.
TEST_P(MixedBlocks, AreNotTakenForSymmetric) {
  const auto& [scene, named] = GetParam();
  Problem problem(network_of(scene.text), named.rule, true);
  if (problem.local.blocks.uniform()) return;
  EXPECT_LE(problem.error(), 1e-13);
}

TEST_P(MixedBlocks, AreNamedWhereTheMatrixIsSingular) {
  const auto& [scene, named] = GetParam();
  Problem problem(network_of(scene.text), named.rule);
  const SolverNumber node(problem.local.free_nodes / 2);
  const int size = problem.local.blocks.size(node);
  std::vector<PetscInt> rows(at(size));
  std::iota(rows.begin(), rows.end(), problem.local.blocks.begin(node));
  petsc::check(MatZeroRowsColumns(problem.matrix, size, rows.data(), 0, nullptr, nullptr));
  EXPECT_FALSE(std::isfinite(problem.error()));
  EXPECT_EQ(problem.pc->pivots().singular_node, node);
}

INSTANTIATE_TEST_SUITE_P(Scenes, MixedBlocks,
                         testing::Combine(testing::ValuesIn(kinds_of_networks), testing::ValuesIn(rules)),
                         [](const auto& item) {
                           return std::get<0>(item.param).name + "_" + std::get<1>(item.param).name;
                         });

TEST(MixedBlocksWork, CountsByUnknowns) {
  const auto updates = [](int size) {
    return Problem(network_of(chain), [size](int, bool) { return size; }).pc->updates_per_node();
  };
  EXPECT_NEAR(updates(6), 4 * updates(3), 1e-9) << "eight times the work on twice the unknowns";
}
