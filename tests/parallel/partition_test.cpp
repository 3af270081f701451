#include "cablenet/partition/partition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <tuple>

#include "../support/networks.hpp"
#include "../support/scenes.hpp"

using namespace cablenet;
using namespace cablenet::test;
using partition::Graph;

namespace {

class Partition : public testing::TestWithParam<NamedScene> {
protected:
  network::Network network_ = network_of(GetParam().text);
  partition::Partition partition_ = partition::make_partition(network_, PETSC_COMM_WORLD);
  int ranks_ = size_of(PETSC_COMM_WORLD);
  std::vector<bool> held_ = held_nodes(network_);
};

void expect_same_everywhere(std::vector<int> values) {
  const std::vector<int> own = values;
  long count = static_cast<long>(values.size());
  MPI_Bcast(&count, 1, MPI_LONG, 0, PETSC_COMM_WORLD);
  values.resize(static_cast<std::size_t>(count));
  MPI_Bcast(values.data(), static_cast<int>(count), MPI_INT, 0, PETSC_COMM_WORLD);
  EXPECT_EQ(own, values);
}

}   // namespace

TEST_P(Partition, EveryFreeNodeHasOneOwnerAndANumberInItsRange) {
  const int free_nodes = static_cast<int>(network_.position.size() - network_.prescribed.size());
  ASSERT_EQ(partition_.node_owner.size(), network_.position.size());
  ASSERT_EQ(partition_.solver_number.size(), network_.position.size());
  ASSERT_EQ(partition_.first_number.size(), at(ranks_) + 1);
  EXPECT_EQ(partition_.first_number.front(), 0);
  EXPECT_EQ(partition_.first_number.back(), free_nodes);
  EXPECT_TRUE(std::is_sorted(partition_.first_number.begin(), partition_.first_number.end()));
  std::set<int> numbers;
  for (std::size_t i = 0; i < held_.size(); ++i) {
    const int owner = partition_.node_owner[i], number = partition_.solver_number[i];
    EXPECT_TRUE(owner >= 0 && owner < ranks_) << "node " << i;
    EXPECT_EQ(held_[i], number == -1) << "node " << i;
    if (held_[i]) continue;
    numbers.insert(number);
    EXPECT_GE(number, partition_.first_number[at(owner)]) << "node " << i;
    EXPECT_LT(number, partition_.first_number[at(owner) + 1]) << "node " << i;
  }
  EXPECT_EQ(static_cast<int>(numbers.size()), free_nodes);
}

TEST_P(Partition, IsTheSameOnAllRanks) {
  expect_same_everywhere(partition_.node_owner);
  expect_same_everywhere(partition_.element_owner);
  expect_same_everywhere(partition_.solver_number);
  expect_same_everywhere(partition_.first_number);
}

TEST_P(Partition, AnElementBelongsToTheOwnerOfAFreeNode) {
  ASSERT_EQ(partition_.element_owner.size(), network_.elements.size());
  for (std::size_t e = 0; e < network_.elements.size(); ++e) {
    std::set<int> allowed;
    for (const int node : network_.elements[e].node)
      if (!held_[at(node)]) allowed.insert(partition_.node_owner[at(node)]);
    // One that is held at both ends may be anywhere where there are rows to say that something is wrong with it.
    const int owner = partition_.element_owner[e];
    if (allowed.empty() && partition_.first_number[at(owner)] < partition_.first_number[at(owner) + 1])
      allowed.insert(owner);
    EXPECT_TRUE(allowed.contains(owner)) << "element " << e;
  }
}

TEST_P(Partition, NoRankIsLeftOutOfALargeNetwork) {
  if (network_.position.size() < 16) return;
  for (int r = 0; r < ranks_; ++r)
    EXPECT_GT(partition_.first_number[at(r) + 1], partition_.first_number[at(r)]) << "rank " << r;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Partition, testing::ValuesIn(kinds_of_networks),
                         [](const auto& scene) { return scene.param.name; });

TEST(PartitionLoops, AreCountedAmongFreeNodes) {
  const auto loops = [](const std::string& text) {
    return partition::make_partition(network_of(text), PETSC_COMM_WORLD).loops;
  };
  EXPECT_EQ(loops(chain), 0);
  EXPECT_EQ(loops(array), 0);
  EXPECT_EQ(loops(two_cables), 0);
  EXPECT_EQ(loops(no_edges), 0);
  EXPECT_EQ(loops(doubled), 1);
  EXPECT_EQ(loops(net), 5 * 3);
}

namespace {

using Edges = std::vector<std::pair<int, int>>;

Graph graph_of(int vertices, const Edges& edges) {
  std::vector<std::vector<int>> neighbours(at(vertices));
  for (const auto& [a, b] : edges) neighbours[at(a)].push_back(b), neighbours[at(b)].push_back(a);
  Graph graph;
  graph.first.push_back(0);
  for (const auto& list : neighbours) {
    graph.adjacent.insert(graph.adjacent.end(), list.begin(), list.end());
    graph.first.push_back(static_cast<int>(graph.adjacent.size()));
  }
  return graph;
}

/// Place in the elimination per vertex; fails the test unless the order is a permutation.
std::vector<int> places(int vertices, const Edges& edges) {
  const std::vector<int> order = partition::elimination_order(graph_of(vertices, edges));
  std::vector<int> place(at(vertices), -1);
  EXPECT_EQ(order.size(), at(vertices));
  for (std::size_t k = 0; k < order.size(); ++k) place.at(at(order[k])) = static_cast<int>(k);
  EXPECT_TRUE(std::none_of(place.begin(), place.end(), [](int k) { return k < 0; }));
  return place;
}

/// Neighbours that come later, per vertex.
std::vector<int> later_neighbours(const std::vector<int>& place, const Edges& edges) {
  std::vector<int> later(place.size(), 0);
  for (const auto& [a, b] : edges) ++later[at(place[at(a)] < place[at(b)] ? a : b)];
  return later;
}

/// A tree whose vertex i > 0 hangs on an earlier one within `reach`, its vertices shuffled.
Edges random_tree(int vertices, int reach, int seed) {
  std::vector<int> name(at(vertices));
  std::iota(name.begin(), name.end(), 0);
  for (int i = vertices - 1; i > 0; --i)
    std::swap(name[at(i)], name[at(static_cast<int>((test::noise(seed + i) + 0.5) * i))]);
  Edges edges;
  for (int i = 1; i < vertices; ++i) {
    const int back = 1 + static_cast<int>((test::noise(seed + 1000 + i) + 0.5) * std::min(reach, i) * 0.999);
    edges.emplace_back(name[at(i)], name[at(i - back)]);
  }
  return edges;
}

}   // namespace

TEST(EliminationOrder, TreesHaveNoFill) {
  for (int seed = 0; seed < 20; ++seed) {
    const int vertices = 2 + 9 * seed;
    const Edges edges = random_tree(vertices, 1 + seed % 7, 17 * seed);
    for (const int count : later_neighbours(places(vertices, edges), edges)) EXPECT_LE(count, 1) << "seed " << seed;
  }
}

TEST(EliminationOrder, ForestsAndLonelyVertices) {
  const Edges edges{{0, 1}, {1, 2}, {4, 5}, {7, 4}, {4, 8}};
  for (const int count : later_neighbours(places(10, edges), edges)) EXPECT_LE(count, 1);
  EXPECT_TRUE(partition::elimination_order({{0}, {}}).empty());
  EXPECT_EQ(partition::elimination_order({{0, 0}, {}}), std::vector<int>{0});
}

TEST(EliminationOrder, HangingBranchesGoBeforeLoops) {
  Edges edges;
  constexpr int side = 6, hanging = 8;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      if (i + 1 < side) edges.emplace_back(i * side + j, (i + 1) * side + j);
      if (j + 1 < side) edges.emplace_back(i * side + j, i * side + j + 1);
    }
  for (int k = 0; k < hanging; ++k) edges.emplace_back(k == 0 ? 14 : side * side + k - 1, side * side + k);
  edges.emplace_back(side * side + 3, side * side + hanging);
  const std::vector<int> place = places(side * side + hanging + 1, edges);
  const std::vector<int> later = later_neighbours(place, edges);
  for (int k = 0; k <= hanging; ++k) {
    EXPECT_LE(place[at(side * side + k)], hanging);
    EXPECT_EQ(later[at(side * side + k)], 1);
  }
}

TEST(EliminationOrder, PairsJoinedTwice) {
  const Edges edges{{0, 1}, {1, 2}, {2, 1}, {2, 3}, {3, 4}, {4, 3}};
  places(5, edges);
}
