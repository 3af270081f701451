#include "cablenet/elimination/elimination.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

using cablenet::at;
using namespace cablenet::elimination;

namespace {

using Edges = std::vector<std::pair<int, int>>;
using Dense = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

double noise(int index) {
  const double value = std::sin(12.9898 * index + 0.37) * 43758.5453;
  return value - std::floor(value) - 0.5;
}

/// A matrix of blocks of the given sizes, with entries on the diagonal and where `edges` are.  Kept blocks come last.
struct System {
  std::vector<int> size;
  int eliminated;
  Edges edges;
  Dense matrix;

  int begin(int block) const { return std::accumulate(size.begin(), size.begin() + block, 0); }
  int unknowns() const { return begin(static_cast<int>(size.size())); }
  bool coupled(int i, int j) const {
    return i == j || std::any_of(edges.begin(), edges.end(),
                                 [&](const auto& e) { return e == std::pair(i, j) || e == std::pair(j, i); });
  }
  BlockGraph block_graph() const {
    BlockGraph graph{size, eliminated, {0}, {}};
    for (int k = 0; k < eliminated; ++k) {
      for (int j = 0; j < static_cast<int>(size.size()); ++j)
        if (coupled(k, j)) graph.adjacent.push_back(j);
      graph.first.push_back(static_cast<int>(graph.adjacent.size()));
    }
    return graph;
  }
  BlockSource source(int row, int column) const {
    if (!coupled(row, column)) return {};
    BlockSource source;
    source.absent = 0;
    source.offset = begin(row) * unknowns() + begin(column);
    source.stride = static_cast<unsigned>(unknowns());
    return source;
  }
  Elimination elimination(bool symmetric) const {
    return {*make_plan(block_graph(), symmetric), [this](int i, int j) { return source(i, j); }};
  }
};

System random_system(std::vector<int> size, int eliminated, const Edges& edges, bool symmetric) {
  System s{std::move(size), eliminated, edges, {}};
  s.matrix = Dense::Zero(s.unknowns(), s.unknowns());
  int seed = 0;
  for (int i = 0; i < static_cast<int>(s.size.size()); ++i)
    for (int j = 0; j < static_cast<int>(s.size.size()); ++j)
      if (s.coupled(i, j))
        s.matrix.block(s.begin(i), s.begin(j), s.size[at(i)], s.size[at(j)]) =
            Dense::NullaryExpr(s.size[at(i)], s.size[at(j)], [&] { return noise(++seed); });
  if (symmetric) s.matrix = (s.matrix + s.matrix.transpose()).eval() / 2;
  s.matrix.diagonal().array() += 6;
  return s;
}

Eigen::VectorXd random_vector(Eigen::Index count) {
  int seed = 900;
  return Eigen::VectorXd::NullaryExpr(count, [&] { return noise(++seed); });
}

/// Solves s by a forward sweep, a dense solution of the kept system, and a backward sweep.
Eigen::VectorXd solve(const System& s, bool symmetric, const Eigen::VectorXd& b) {
  Elimination elimination = s.elimination(symmetric);
  Eigen::VectorXd w = b;
  for (int repetition = 0; repetition < 2; ++repetition) {
    EXPECT_EQ(elimination.factor({s.matrix.data(), nullptr, nullptr}).singular, -1);
    const int first = s.begin(s.eliminated), count = s.unknowns() - first;
    Dense kept = s.matrix.bottomRightCorner(count, count);
    for (const Plan::Kept& block : elimination.plan().kept) {
      const int rows = s.size[at(block.row)], columns = s.size[at(block.column)];
      const Eigen::Map<const Dense> update(elimination.update(block), rows, columns);
      const int i = s.begin(block.row) - first, j = s.begin(block.column) - first;
      kept.block(i, j, rows, columns) += update;
      if (elimination.plan().symmetric && i != j) kept.block(j, i, columns, rows) += update.transpose();
    }
    w = b;
    // The kept values stand elsewhere, or nowhere.
    Eigen::VectorXd elsewhere = w.tail(count);
    double* const values = count > 0 ? elsewhere.data() : nullptr;
    elimination.forward(w.data(), values);
    if (count > 0) elsewhere = kept.partialPivLu().solve(elsewhere).eval();
    elimination.backward(w.data(), values);
    w.tail(count) = elsewhere;
  }
  return w;
}

const Edges chain{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}};
const Edges tree{{0, 3}, {1, 3}, {2, 4}, {3, 6}, {4, 6}, {5, 6}};
const Edges loops{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {2, 5}, {4, 5}, {5, 6}, {6, 1}, {3, 7}, {7, 6}};

struct Case {
  const char* name;
  std::vector<int> size;
  int eliminated;
  Edges edges;
  bool symmetric;
  friend void PrintTo(const Case& item, std::ostream* out) { *out << item.name; }
};

const std::vector<Case> cases{
    {"chain", std::vector<int>(6, 3), 6, chain, false},
    {"chain_symmetric", std::vector<int>(6, 3), 6, chain, true},
    {"chain_between_kept", std::vector<int>(6, 3), 4, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {0, 5}}, false},
    {"chain_between_kept_symmetric", std::vector<int>(6, 3), 4, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {0, 5}}, true},
    {"tree", std::vector<int>(7, 3), 7, tree, false},
    {"tree_symmetric", std::vector<int>(7, 3), 7, tree, true},
    {"loops", std::vector<int>(8, 3), 8, loops, false},
    {"loops_symmetric", std::vector<int>(8, 3), 8, loops, true},
    {"loops_kept", std::vector<int>(8, 3), 5, loops, false},
    {"loops_kept_symmetric", std::vector<int>(8, 3), 5, loops, true},
    {"all_kept", std::vector<int>(3, 3), 0, {{0, 1}, {1, 2}}, false},
    {"bodies", {3, 3, 7, 3, 3, 7, 6, 3}, 8, loops, false},
    {"bodies_kept", {3, 3, 7, 3, 3, 7, 6, 3}, 6, loops, false},
    {"bodies_symmetric", {3, 3, 7, 3, 3, 7, 6, 3}, 6, loops, true},
    {"bodies_side_by_side", {7, 3, 7, 6, 7, 3, 6, 6}, 8, loops, false},
    {"bodies_all_kept", {3, 3, 3, 3, 3, 6, 7, 7}, 5, loops, false},
    {"bodies_only", {6, 7, 6, 7, 7, 6, 7, 6}, 6, loops, false},
    {"sizes_of_neither", {5, 3, 7, 4, 1, 6, 3, 2}, 6, loops, false},
    {"nothing", {}, 0, {}, false},
};

class EliminationOf : public testing::TestWithParam<Case> {};

/// A chain of stiff elements with light nodes.  An element adds K + mass/2 on the diagonal, and mass/4 - K beside it.
System stiff_chain(int nodes, double stiffness, double mass, bool symmetric) {
  Edges edges;
  for (int i = 1; i < nodes; ++i) edges.emplace_back(i - 1, i);
  System s{std::vector<int>(at(nodes), 3), nodes, edges, Dense::Zero(3 * nodes, 3 * nodes)};
  for (int i = 0; i < nodes; ++i) {
    Eigen::Vector3d e(1 + noise(3 * i), noise(3 * i + 1), noise(3 * i + 2)), mean = e;
    if (!symmetric) mean += 1e-3 * Eigen::Vector3d(noise(7 * i), noise(7 * i + 1), noise(7 * i + 2));
    const Eigen::Matrix3d K = stiffness * mean.normalized() * e.normalized().transpose();
    const Eigen::Matrix3d M = mass / 4 * Eigen::Matrix3d::Identity();
    s.matrix.block<3, 3>(3 * i, 3 * i) += K + 2 * M;
    if (i + 1 == nodes) break;
    s.matrix.block<3, 3>(3 * i + 3, 3 * i + 3) += K + 2 * M;
    s.matrix.block<3, 3>(3 * i, 3 * i + 3) = M - K;
    s.matrix.block<3, 3>(3 * i + 3, 3 * i) = M - K;
  }
  return s;
}

/// A stiff chain of nodes of 1 kg.  After every second node comes a light body, which is attached far from its centre.
System stiff_bodies(int blocks) {
  Edges edges;
  std::vector<int> size;
  for (int i = 0; i < blocks; ++i) size.push_back(i % 3 == 2 ? 7 : 3);
  for (int i = 1; i < blocks; ++i) edges.emplace_back(i - 1, i);
  System s{size, blocks, edges, {}};
  s.matrix = Dense::Zero(s.unknowns(), s.unknowns());
  for (int i = 0; i < blocks; ++i) {
    s.matrix.diagonal().segment(s.begin(i), 3).array() += 1;
    s.matrix.diagonal().segment(s.begin(i) + 3, size[at(i)] - 3).array() += 1e-2;
    if (i == 0) continue;
    const int unknowns = size[at(i - 1)] + size[at(i)];
    const Eigen::Vector3d e = Eigen::Vector3d(1 + noise(3 * i), noise(3 * i + 1), noise(3 * i + 2)).normalized();
    int seed = 50 * i;
    Eigen::Matrix3Xd arms = Eigen::Matrix3Xd::NullaryExpr(3, unknowns, [&] { return 5 * noise(++seed); });
    arms.leftCols<3>() = -Eigen::Matrix3d::Identity();
    arms.middleCols<3>(size[at(i - 1)]) = Eigen::Matrix3d::Identity();
    const Eigen::RowVectorXd stretch = e.transpose() * arms;
    s.matrix.block(s.begin(i - 1), s.begin(i - 1), unknowns, unknowns) += 1e9 * stretch.transpose() * stretch;
  }
  return s;
}

}   // namespace

TEST_P(EliminationOf, SolvesLikeADenseMatrix) {
  const Case& item = GetParam();
  const System s = random_system(item.size, item.eliminated, item.edges, item.symmetric);
  const Eigen::VectorXd b = random_vector(s.unknowns());
  const Eigen::VectorXd x = solve(s, item.symmetric, b);
  EXPECT_LE((s.matrix * x - b).norm(), 1e-13 * b.norm());
}

TEST_P(EliminationOf, ReadsSymmetricSourcesFromTheOtherTriangle) {
  const Case& item = GetParam();
  if (!item.symmetric) return;
  System s = random_system(item.size, item.eliminated, item.edges, true);
  const auto transposed = [&s](int i, int j) {
    BlockSource source = s.source(j, i);
    source.transposed = 1;
    return source;
  };
  Elimination direct = s.elimination(true), other(*make_plan(s.block_graph(), true), transposed);
  Eigen::VectorXd w = random_vector(s.unknowns()), v = w;
  direct.factor({s.matrix.data(), nullptr, nullptr});
  other.factor({s.matrix.data(), nullptr, nullptr});
  direct.forward(w.data(), w.data() + s.begin(s.eliminated));
  other.forward(v.data(), v.data() + s.begin(s.eliminated));
  EXPECT_LE((w - v).norm(), 1e-14 * w.norm());
}

INSTANTIATE_TEST_SUITE_P(Patterns, EliminationOf, testing::ValuesIn(cases),
                         [](const auto& item) { return item.param.name; });

TEST(Elimination, KeepsItsDigitsOnStiffElements) {
  for (const bool symmetric : {false, true}) {
    const System s = stiff_chain(200, 1e9, 1, symmetric);
    const Eigen::VectorXd exact = random_vector(s.unknowns()), b = s.matrix * exact;
    const Eigen::VectorXd x = solve(s, symmetric, b);
    EXPECT_LE((s.matrix * x - b).norm(), 1e-14 * b.norm());
  }
}

TEST(Elimination, KeepsItsDigitsOnLightBodiesAtStiffElements) {
  const System s = stiff_bodies(90);
  const Eigen::VectorXd exact = random_vector(s.unknowns()), b = s.matrix * exact;
  const Eigen::VectorXd x = solve(s, false, b), dense = s.matrix.partialPivLu().solve(b);
  EXPECT_LE((s.matrix * x - b).norm(), 1e-14 * b.norm());
  EXPECT_LE((x - exact).norm(), 2 * (dense - exact).norm());
}

TEST(Elimination, ExchangesRowsWithinABody) {
  for (const int body : {5, 6, 7}) {
    System s = random_system({3, body, 3, body}, 4, {{0, 1}, {1, 2}, {2, 3}}, false);
    for (const int block : {1, 3})
      s.matrix.middleRows(s.begin(block), body) = s.matrix.middleRows(s.begin(block), body).colwise().reverse().eval();
    const Eigen::VectorXd b = random_vector(s.unknowns());
    EXPECT_LE((s.matrix * solve(s, false, b) - b).norm(), 1e-13 * b.norm());
  }
}

TEST(Elimination, HoldsPivotsAgainstTheirColumns) {
  System s = random_system({7}, 1, {}, false);
  s.matrix.rightCols<4>() *= 1e-20;
  EXPECT_EQ(s.elimination(false).factor({s.matrix.data(), nullptr, nullptr}).singular, -1);
  s.matrix.col(5) = s.matrix.col(3);
  EXPECT_EQ(s.elimination(false).factor({s.matrix.data(), nullptr, nullptr}).singular, 0);
}

/// The pivots of a diagonal matrix are its entries, exactly.
TEST(Elimination, TakesAPivotOfTheSizeOfRoundingForSingular) {
  const double eps = std::numeric_limits<double>::epsilon();
  for (const bool symmetric : {false, true})
    for (const int pivot : {0, 1, 2})
      for (const double size : {0.0, 0.5, -0.5, 2.0, -2.0}) {
        System s{{3, 3}, 2, {{0, 1}}, Dense::Identity(6, 6)};
        s.matrix(3 + pivot, 3 + pivot) = size * eps;
        const Pivots pivots = s.elimination(symmetric).factor({s.matrix.data(), nullptr, nullptr});
        EXPECT_EQ(pivots.singular, std::abs(size) > 1 ? -1 : 1) << "pivot " << pivot << ", " << size << " eps";
        EXPECT_EQ(pivots.negative, size < -1 ? 1 : 0);
      }
}

/// Another row's entry makes the column large, and is none of its pivot.
TEST(Elimination, TakesABodysPivotOfTheSizeOfRoundingForSingular) {
  const double eps = std::numeric_limits<double>::epsilon();
  for (const int body : {5, 6, 7})
    for (int pivot = 1; pivot < body; ++pivot)
      for (const double size : {0.0, 0.5, -0.5, 2.0, -2.0}) {
        System s{{3, body}, 2, {{0, 1}}, Dense::Identity(3 + body, 3 + body)};
        s.matrix(3, 3 + pivot) = 1;
        s.matrix(3 + pivot, 3 + pivot) = size * eps;
        const Pivots pivots = s.elimination(false).factor({s.matrix.data(), nullptr, nullptr});
        EXPECT_EQ(pivots.singular, std::abs(size) > 1 ? -1 : 1) << "pivot " << pivot << ", " << size << " eps";
      }
}

TEST(Elimination, NamesTheSingularPivot) {
  for (const bool symmetric : {false, true}) {
    System s = random_system(std::vector<int>(6, 3), 6, chain, symmetric);
    s.matrix.block<3, 18>(0, 0).setZero();
    s.matrix.block<18, 3>(0, 0).setZero();
    Elimination elimination = s.elimination(symmetric);
    EXPECT_EQ(elimination.factor({s.matrix.data(), nullptr, nullptr}).singular, 0);
    s = random_system(std::vector<int>(6, 3), 6, chain, symmetric);
    s.matrix(9, 9) = std::nan("");
    EXPECT_EQ(elimination.factor({s.matrix.data(), nullptr, nullptr}).singular, 3);
  }
  System bodies = random_system({3, 7, 3}, 3, {{0, 1}, {1, 2}}, false);
  bodies.matrix.middleRows<7>(3).setZero();
  EXPECT_EQ(bodies.elimination(false).factor({bodies.matrix.data(), nullptr, nullptr}).singular, 1);
  bodies.matrix.middleRows<7>(3) = random_system({3, 7, 3}, 3, {{0, 1}, {1, 2}}, false).matrix.middleRows<7>(3);
  bodies.matrix(8, 5) = std::nan("");
  EXPECT_EQ(bodies.elimination(false).factor({bodies.matrix.data(), nullptr, nullptr}).singular, 1);
}

TEST(Elimination, CountsNegativeEigenvalues) {
  System s = random_system(std::vector<int>(8, 3), 8, loops, true);
  s.matrix.diagonal().segment<7>(8).array() -= 14;
  const auto eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(s.matrix).eigenvalues();
  const Pivots pivots = s.elimination(true).factor({s.matrix.data(), nullptr, nullptr});
  EXPECT_EQ(pivots.negative, (eigenvalues.array() < 0).count());
  EXPECT_GT(pivots.negative, 3);
}

TEST(Elimination, CountsABodysNegativeEigenvalues) {
  System s = random_system({3, 7, 3, 6, 7, 3}, 6, chain, true);
  s.matrix *= 0.1;
  for (const auto& [block, negative] : {std::pair{0, 3}, {1, 5}, {3, 4}, {4, 1}, {5, 1}})
    s.matrix.diagonal().segment(s.begin(block), negative).array() -= 2;
  const auto eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(s.matrix).eigenvalues();
  Elimination elimination = s.elimination(false);
  const Pivots pivots = elimination.factor({s.matrix.data(), nullptr, nullptr});
  EXPECT_EQ(pivots.negative + elimination.negative_in_bodies(), (eigenvalues.array() < 0).count());
  EXPECT_GE(elimination.negative_in_bodies(), 3);
}

/// Blocks that have no factors without exchanges: pairs of unknowns that are coupled and have no diagonal.
TEST(Elimination, CountsTheNegativeOneOfEachPairWithoutDiagonal) {
  System s{{3, 6}, 2, {{0, 1}}, Dense::Identity(9, 9)};
  s.matrix.bottomRightCorner<6, 6>().setZero();
  for (const auto& [i, j, coupling] : {std::tuple{3, 7, 1.0}, {4, 6, -1e9}, {5, 8, 1e-9}})
    s.matrix(i, j) = s.matrix(j, i) = coupling;
  Elimination elimination = s.elimination(false);
  EXPECT_EQ(elimination.factor({s.matrix.data(), nullptr, nullptr}).singular, -1);
  EXPECT_EQ(elimination.negative_in_bodies(), 3);
}

TEST(Plan, CountsItsWorkAndGivesUpBeyondTheLimit) {
  const System s = random_system(std::vector<int>(7, 3), 7, tree, false);
  EXPECT_EQ(make_plan(s.block_graph(), false)->updates, 6);
  EXPECT_EQ(make_plan(s.block_graph(), false)->later.size(), 6u);
  EXPECT_FALSE(make_plan(s.block_graph(), false, 5).has_value());
}

TEST(Plan, IsRefusedForBlocksThatAreEmptyOrTooLarge) {
  for (const int size : {1, 3, 7})
    for (const int eliminated : {1, 2})
      EXPECT_TRUE(make_plan({{3, size}, eliminated, {0, 0, 0}, {}}, false).has_value()) << size;
  for (const int size : {-1, 0, 8})
    for (const int eliminated : {1, 2})
      EXPECT_THROW(make_plan({{3, size}, eliminated, {0, 0, 0}, {}}, false), std::invalid_argument) << size;
}

TEST(Plan, AStarCostsLinearlyInItsArms) {
  for (const int hub : {3, 7})
    for (const int arms : {100, 200})
      for (const bool kept : {false, true}) {
        Edges star;
        for (int i = 0; i < arms; ++i) star.emplace_back(i, arms);
        std::vector<int> size(at(arms), 3);
        size.push_back(hub);
        const System s{size, kept ? arms : arms + 1, star, {}};
        EXPECT_NEAR(make_plan(s.block_graph(), false)->updates, arms * hub * hub / 9.0, 1e-9);
      }
}
