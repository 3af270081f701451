#include "cablenet/partition/cut.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "../support/graphs.hpp"

using namespace cablenet;
using namespace cablenet::test;
using partition::Graph;

namespace {

struct Measured {
  std::vector<double> cost;   ///< per part
  std::vector<int> size;      ///< vertices per part
  int interface = 0;

  double imbalance() const {
    const double sum = std::accumulate(cost.begin(), cost.end(), 0.0);
    return *std::max_element(cost.begin(), cost.end()) * static_cast<double>(cost.size()) / sum - 1;
  }
};

Measured measure(const Graph& graph, int parts) {
  const std::vector<int> part = partition::cut_network(graph, parts);
  const std::vector<bool> interface = partition::find_interface(graph, part);
  const std::vector<int> cost = partition::step_cost(graph, interface);
  Measured found{std::vector<double>(at(parts), 0.0), std::vector<int>(at(parts), 0), 0};
  for (std::size_t v = 0; v < part.size(); ++v) {
    found.cost.at(at(part[v])) += cost[v];
    ++found.size[at(part[v])];
    found.interface += interface[v];
  }
  return found;
}

std::vector<int> members(const std::vector<bool>& set) {
  std::vector<int> found;
  for (std::size_t v = 0; v < set.size(); ++v)
    if (set[v]) found.push_back(static_cast<int>(v));
  return found;
}

/// A path on which equal branches hang at equal distances.
Edges comb(int trunk, int branches, int branch) {
  Edges edges = path(trunk);
  for (int b = 0; b < branches; ++b)
    for (int k = 0; k < branch; ++k) {
      const int tip = trunk + b * branch + k;
      edges.emplace_back(k == 0 ? (2 * b + 1) * trunk / (2 * branches) : tip - 1, tip);
    }
  return edges;
}

/// Compares the interface graph with what the slow elimination of all other vertices leaves.
void expect_interface_graph(int vertices, const Edges& edges, const std::vector<bool>& interface) {
  std::vector<bool> others = interface;
  others.flip();
  const std::vector<std::set<int>> left = eliminate(vertices, edges, members(others)).left;
  const std::vector<int> index = members(interface);
  const Graph found = partition::interface_graph(graph_of(vertices, edges), interface);
  ASSERT_EQ(found.vertices(), static_cast<int>(index.size()));
  for (std::size_t i = 0; i < index.size(); ++i) {
    std::multiset<int> neighbours;
    for (int k = found.first[i]; k < found.first[i + 1]; ++k) neighbours.insert(index[at(found.adjacent[at(k)])]);
    const std::set<int>& expected = left[at(index[i])];
    EXPECT_EQ(neighbours, std::multiset<int>(expected.begin(), expected.end())) << "vertex " << index[i];
  }
}

}   // namespace

TEST(CutNetwork, ChainHasLongerEndsSinceTheyCostLess) {
  constexpr int vertices = 3000;
  Measured found = measure(graph_of(vertices, path(vertices)), 4);
  EXPECT_EQ(found.interface, 3);
  EXPECT_LT(found.imbalance(), 0.03);
  std::sort(found.size.begin(), found.size.end());
  for (const std::size_t part : {0, 1}) EXPECT_NEAR(found.size[part], vertices * 4 / 18.0, 0.01 * vertices);
  for (const std::size_t part : {2, 3}) EXPECT_NEAR(found.size[part], vertices * 5 / 18.0, 0.01 * vertices);
}

TEST(CutNetwork, ArrayIsBalancedWithFewInterfaceVertices) {
  constexpr int trunk = 5000, branches = 20, branch = 250;
  const Graph graph = graph_of(trunk + branches * branch, comb(trunk, branches, branch));
  for (const int parts : {2, 3, 4, 7, 16}) {
    const Measured found = measure(graph, parts);
    EXPECT_LT(found.imbalance(), 0.03) << parts << " parts";
    EXPECT_LE(found.interface, parts + parts / 3) << parts << " parts";
  }
}

TEST(CutNetwork, LeavesNoPartEmptyWhereThereIsEnough) {
  for (int seed = 0; seed < 30; ++seed) {
    const int vertices = 16 + 3 * seed;
    for (const Edges& edges : {random_tree(vertices, 3, seed), random_pairs(vertices, vertices / 2, seed)}) {
      const Measured found = measure(graph_of(vertices, edges), 2 + seed % 4);
      EXPECT_GT(*std::min_element(found.size.begin(), found.size.end()), 0) << "seed " << seed;
    }
  }
}

TEST(CutNetwork, SeparateCablesAreBalanced) {
  Edges edges = path(4000);
  std::erase_if(edges, [](const auto& edge) { return edge.second % 400 == 0; });
  const Measured found = measure(graph_of(4000, edges), 4);
  EXPECT_LT(found.imbalance(), 0.05);
}

/// Many cables hang on one node, such as a body.  Cutting any number of its edges costs one interface vertex.
TEST(CutNetwork, AHubsBranchesAreSharedOut) {
  constexpr int branches = 600, branch = 5;
  Edges edges;
  for (int b = 0; b < branches; ++b)
    for (int k = 0; k < branch; ++k) {
      const int tip = 1 + b * branch + k;
      edges.emplace_back(k == 0 ? 0 : tip - 1, tip);
    }
  for (const int parts : {2, 3, 8}) {
    const Measured found = measure(graph_of(1 + branches * branch, edges), parts);
    EXPECT_LT(found.imbalance(), 0.05) << parts << " parts";
    EXPECT_LE(found.interface, parts) << parts << " parts";
  }
}

TEST(CutNetwork, MorePartsThanVerticesHaveOneEach) {
  const std::vector<int> part = partition::cut_network(graph_of(3, path(3)), 5);
  EXPECT_EQ(std::set<int>(part.begin(), part.end()).size(), 3u);
  EXPECT_TRUE(partition::cut_network({{0}, {}}, 4).empty());
  EXPECT_EQ(partition::cut_network(graph_of(3, path(3)), 1), std::vector<int>(3, 0));
}

TEST(FindInterface, TakesTheVertexWithMostCutEdges) {
  const Graph star = graph_of(5, {{4, 0}, {4, 1}, {4, 2}, {4, 3}});
  EXPECT_EQ(members(partition::find_interface(star, {0, 1, 2, 2, 3})), std::vector<int>{4});
  const Graph chain = graph_of(5, path(5));
  EXPECT_EQ(members(partition::find_interface(chain, {0, 1, 0, 1, 0})), (std::vector<int>{1, 3}));
  EXPECT_EQ(members(partition::find_interface(chain, {0, 0, 0, 1, 1})), std::vector<int>{2});
  EXPECT_TRUE(members(partition::find_interface(chain, {0, 0, 0, 0, 0})).empty());
}

TEST(FindInterface, DropsWhatTheOthersCover) {
  const Graph graph = graph_of(10, {{0, 1}, {0, 2}, {0, 3}, {1, 4}, {1, 5}, {2, 6}, {2, 7}, {3, 8}, {3, 9}});
  const std::vector<int> part{0, 1, 1, 1, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(members(partition::find_interface(graph, part)), (std::vector<int>{1, 2, 3}));
}

TEST(FindInterface, CoversEveryCutAndNoVertexIsNeedless) {
  for (int seed = 0; seed < 40; ++seed) {
    const int vertices = 10 + 2 * seed;
    const Graph graph = partition::simple_graph(graph_of(vertices, random_pairs(vertices, 2 * vertices, 11 * seed)));
    std::vector<int> part;
    for (int v = 0; v < vertices; ++v) part.push_back(draw(3, 700 * seed + v));
    const std::vector<bool> interface = partition::find_interface(graph, part);
    for (int v = 0; v < vertices; ++v) {
      int open = 0;
      for (int k = graph.first[at(v)]; k < graph.first[at(v) + 1]; ++k)
        open += part[at(graph.adjacent[at(k)])] != part[at(v)] && !interface[at(graph.adjacent[at(k)])];
      EXPECT_EQ(open > 0, interface[at(v)]) << "vertex " << v << " seed " << seed;
    }
  }
}

TEST(StepCost, IsHigherBetweenInterfaceVertices) {
  const Edges edges{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {2, 6}, {6, 7}};
  std::vector<bool> interface(8, false);
  EXPECT_EQ(partition::step_cost(graph_of(8, edges), interface), std::vector<int>(8, 4));
  interface[0] = interface[4] = true;
  EXPECT_EQ(partition::step_cost(graph_of(8, edges), interface), (std::vector<int>{4, 5, 5, 5, 4, 4, 4, 4}));
}

TEST(InterfaceGraph, IsWhatEliminationOfTheOthersLeaves) {
  for (int seed = 0; seed < 40; ++seed) {
    const int vertices = 8 + 2 * seed;
    std::vector<bool> interface;
    for (int v = 0; v < vertices; ++v) interface.push_back(draw(3, 900 * seed + v) == 0);
    expect_interface_graph(vertices, random_tree(vertices, 4, 13 * seed), interface);
    expect_interface_graph(vertices, random_pairs(vertices, vertices, 13 * seed), interface);
  }
  expect_interface_graph(5, path(5), std::vector<bool>(5, true));
  expect_interface_graph(5, path(5), std::vector<bool>(5, false));
}
