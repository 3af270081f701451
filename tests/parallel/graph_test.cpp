#include "cablenet/partition/graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "../support/graphs.hpp"

using namespace cablenet;
using namespace cablenet::test;
using partition::Graph;

namespace {

std::vector<bool> flags(int vertices, const std::vector<int>& set) {
  std::vector<bool> flag(at(vertices), false);
  for (const int v : set) flag[at(v)] = true;
  return flag;
}

struct Order {
  std::vector<int> order;
  std::vector<int> later;   ///< per vertex in the order: number of neighbours left, fill included
};

/// The order of elimination of a graph.  The test fails unless every vertex that is not kept is in it exactly once.
Order order_of(int vertices, const Edges& edges, const std::vector<int>& kept = {}) {
  Order found;
  found.order = partition::elimination_order(graph_of(vertices, edges), flags(vertices, kept));
  std::vector<int> all = found.order;
  all.insert(all.end(), kept.begin(), kept.end());
  std::sort(all.begin(), all.end());
  std::vector<int> expected(at(vertices));
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(all, expected);
  found.later = eliminate(vertices, edges, found.order).later;
  return found;
}

int most_later(int vertices, const Edges& edges, const std::vector<int>& kept = {}) {
  const std::vector<int> later = order_of(vertices, edges, kept).later;
  return later.empty() ? 0 : *std::max_element(later.begin(), later.end());
}

}   // namespace

TEST(EliminationOrder, TreesHaveNoFill) {
  for (int seed = 0; seed < 20; ++seed) {
    const int vertices = 2 + 9 * seed;
    EXPECT_LE(most_later(vertices, random_tree(vertices, 1 + seed % 7, 17 * seed)), 1) << "seed " << seed;
  }
}

TEST(EliminationOrder, TreesWithOneKeptVertexHaveNoFill) {
  for (int seed = 0; seed < 20; ++seed) {
    const int vertices = 2 + 9 * seed;
    const Edges edges = random_tree(vertices, 1 + seed % 7, 17 * seed);
    EXPECT_LE(most_later(vertices, edges, {seed % vertices}), 1) << "seed " << seed;
  }
}

/// A hub stands for a body with many cables.  The last arm's vertices may come after it.
TEST(EliminationOrder, AHubComesAfterAllItsArmsButOne) {
  constexpr int arms = 200, length = 5, hub = 37, vertices = arms * length + 1;
  Edges edges;
  int next = 0;
  for (int arm = 0; arm < arms; ++arm)
    for (int i = 0, last = hub; i < length; ++i, last = next++) {
      if (next == hub) ++next;
      edges.emplace_back(last, next);
    }
  const Order found = order_of(vertices, edges);
  EXPECT_LE(*std::max_element(found.later.begin(), found.later.end()), 1);
  const auto behind = found.order.end() - std::find(found.order.begin(), found.order.end(), hub);
  EXPECT_LE(behind, length + 1);
  EXPECT_EQ(order_of(vertices, edges, {hub}).later, std::vector<int>(vertices - 1, 1));
}

TEST(EliminationOrder, ForestsAndLonelyVertices) {
  EXPECT_LE(most_later(10, {{0, 1}, {1, 2}, {4, 5}, {7, 4}, {4, 8}}), 1);
  EXPECT_TRUE(partition::elimination_order({{0}, {}}).empty());
  EXPECT_EQ(partition::elimination_order({{0, 0}, {}}), std::vector<int>{0});
  EXPECT_TRUE(partition::elimination_order({{0, 0}, {}}, {true}).empty());
}

TEST(EliminationOrder, SeriesParallelGraphsLeaveTwoNeighbours) {
  for (int seed = 0; seed < 60; ++seed) {
    const int vertices = 3 + 2 * seed;
    EXPECT_LE(most_later(vertices, random_series_parallel(vertices, 91 * seed)), 2) << "seed " << seed;
  }
}

TEST(EliminationOrder, PathsBetweenTheSameTwoVerticesLeaveTwoNeighbours) {
  Edges edges;
  for (int i = 2; i < 40; i += 2) edges.insert(edges.end(), {{0, i}, {i, i + 1}, {i + 1, 1}});
  EXPECT_EQ(most_later(40, edges), 2);
  EXPECT_EQ(most_later(40, edges, {0, 1}), 2);
}

TEST(EliminationOrder, ChainBetweenKeptVerticesRunsFromEndToEnd) {
  constexpr int vertices = 50;
  for (int seed = 0; seed < 10; ++seed) {
    const std::vector<int> name = shuffled(vertices, 71 * seed);
    Edges edges = path(vertices);
    for (auto& [a, b] : edges) a = name[at(a)], b = name[at(b)];
    const Order found = order_of(vertices, edges, {name.front(), name.back()});
    EXPECT_EQ(found.later, std::vector<int>(vertices - 2, 2));
    std::vector<int> expected(name.begin() + 1, name.end() - 1);
    if (found.order.front() != expected.front()) std::reverse(expected.begin(), expected.end());
    EXPECT_EQ(found.order, expected) << "seed " << seed;
  }
}

TEST(EliminationOrder, RingRunsAround) {
  constexpr int vertices = 30;
  Edges edges = path(vertices);
  edges.emplace_back(vertices - 1, 0);
  const Order found = order_of(vertices, edges);
  for (std::size_t k = 0; k + 1 < found.order.size(); ++k) {
    const int step = (found.order[k + 1] - found.order[k] + vertices) % vertices;
    EXPECT_TRUE(step == 1 || step == vertices - 1) << "after " << k;
  }
}

TEST(EliminationOrder, KeptVerticesCountAsNeighbours) {
  // The middle of a star between three kept ends is neither peeled nor contracted.  What hangs on its arms is peeled.
  const Edges edges{{0, 1}, {1, 2}, {1, 3}, {1, 4}, {4, 5}, {0, 6}, {6, 7}};
  const Order found = order_of(8, edges, {0, 2, 3});
  EXPECT_EQ(found.order.back(), 1);
  EXPECT_EQ(found.later.back(), 3);
  EXPECT_EQ(std::count(found.later.begin(), found.later.end(), 1), 4);
}

TEST(EliminationOrder, ManyKeptVerticesOfAnyGraph) {
  for (int seed = 0; seed < 40; ++seed) {
    const int vertices = 4 + 3 * seed;
    std::vector<int> kept;
    for (int v = 0; v < vertices; ++v)
      if (draw(4, 500 * seed + v) == 0) kept.push_back(v);
    order_of(vertices, random_pairs(vertices, 1 + vertices * (1 + seed % 3), 37 * seed), kept);
  }
}

TEST(EliminationOrder, HangingBranchesGoBeforeLoops) {
  constexpr int side = 6, hanging = 8;
  Edges edges = grid(side);
  for (int k = 0; k < hanging; ++k) edges.emplace_back(k == 0 ? 14 : side * side + k - 1, side * side + k);
  edges.emplace_back(side * side + 3, side * side + hanging);
  const Order found = order_of(side * side + hanging + 1, edges);
  for (std::size_t k = 0; k <= hanging; ++k) {
    EXPECT_GE(found.order[k], side * side);
    EXPECT_EQ(found.later[k], 1);
  }
}

TEST(EliminationOrder, NetsAreDissected) {
  constexpr int side = 24;
  // An elimination row by row would leave `side` neighbours to each of side^2 vertices.
  const std::vector<int> later = order_of(side * side, grid(side)).later;
  EXPECT_LT(std::accumulate(later.begin(), later.end(), 0), side * side * side / 2);
}

TEST(EliminationOrder, PairsJoinedTwiceCountOnce) {
  EXPECT_EQ(most_later(5, {{0, 1}, {1, 2}, {2, 1}, {2, 3}, {3, 4}, {4, 3}}), 1);
  const Order found = order_of(4, {{0, 1}, {1, 0}, {0, 2}, {2, 0}, {1, 2}, {2, 3}});
  EXPECT_EQ(found.order.front(), 3);
}

TEST(SimpleGraph, JoinsEveryPairOnce) {
  const Graph simple = partition::simple_graph(graph_of(4, {{2, 0}, {0, 1}, {1, 0}, {2, 2}, {0, 2}}));
  EXPECT_EQ(simple.first, (std::vector<int>{0, 2, 3, 4, 4}));
  EXPECT_EQ(simple.adjacent, (std::vector<int>{1, 2, 0, 0}));
}

TEST(ConnectedPieces, AreNumberedWithoutBarredVertices) {
  const Graph graph = graph_of(7, {{0, 1}, {1, 2}, {2, 3}, {5, 6}});
  EXPECT_EQ(partition::connected_pieces(graph), (std::vector<int>{0, 0, 0, 0, 1, 2, 2}));
  EXPECT_EQ(partition::connected_pieces(graph, flags(7, {1, 5})), (std::vector<int>{0, -1, 1, 1, 2, -1, 3}));
  EXPECT_EQ(partition::count_loops(graph), 0);
  EXPECT_EQ(partition::count_loops(graph_of(25, grid(5))), 16);
}

TEST(Unpeeled, IsWhatLiesBetweenKeptVertices) {
  const Graph graph = graph_of(8, {{0, 1}, {1, 2}, {2, 3}, {2, 4}, {4, 5}, {0, 6}, {6, 7}});
  EXPECT_EQ(partition::unpeeled(graph, flags(8, {0, 4})), flags(8, {0, 1, 2, 4}));
  EXPECT_EQ(partition::unpeeled(graph, flags(8, {})), flags(8, {}));
}
