#pragma once
#include <algorithm>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "cablenet/partition/graph.hpp"
#include "networks.hpp"

/// Tests make graphs from pairs of vertices or at random, and find out in a slow and simple way what elimination does.
namespace cablenet::test {

using Edges = std::vector<std::pair<int, int>>;

inline partition::Graph graph_of(int vertices, const Edges& edges) {
  std::vector<std::vector<int>> neighbours(at(vertices));
  for (const auto& [a, b] : edges) neighbours[at(a)].push_back(b), neighbours[at(b)].push_back(a);
  partition::Graph graph;
  graph.first.push_back(0);
  for (const auto& list : neighbours) {
    graph.adjacent.insert(graph.adjacent.end(), list.begin(), list.end());
    graph.first.push_back(static_cast<int>(graph.adjacent.size()));
  }
  return graph;
}

struct Eliminated {
  std::vector<int> later;            ///< per vertex in `order`: number of neighbours when it is eliminated
  std::vector<std::set<int>> left;   ///< per vertex: neighbours when it was eliminated, or else at the end
};

inline Eliminated eliminate(int vertices, const Edges& edges, const std::vector<int>& order) {
  Eliminated result{{}, std::vector<std::set<int>>(at(vertices))};
  for (const auto& [a, b] : edges)
    if (a != b) result.left[at(a)].insert(b), result.left[at(b)].insert(a);
  for (const int v : order) {
    const std::set<int>& around = result.left[at(v)];
    result.later.push_back(static_cast<int>(around.size()));
    for (const int a : around) {
      result.left[at(a)].insert(around.begin(), around.end());
      result.left[at(a)].erase(a);
      result.left[at(a)].erase(v);
    }
  }
  return result;
}

/// A number from 0 to count - 1, which is always the same for a seed.
inline int draw(int count, int seed) { return static_cast<int>((noise(seed) + 0.5) * 0.999 * count); }

/// Random names for the vertices of a graph: vertex i becomes result[i].
inline std::vector<int> shuffled(int vertices, int seed) {
  std::vector<int> name(at(vertices));
  std::iota(name.begin(), name.end(), 0);
  for (int i = vertices - 1; i > 0; --i) std::swap(name[at(i)], name[at(draw(i + 1, seed + i))]);
  return name;
}

inline Edges path(int vertices) {
  Edges edges;
  for (int i = 1; i < vertices; ++i) edges.emplace_back(i - 1, i);
  return edges;
}

/// A tree in which vertex i > 0 hangs on one of the `reach` vertices before it.  The vertices are then shuffled.
inline Edges random_tree(int vertices, int reach, int seed) {
  const std::vector<int> name = shuffled(vertices, seed);
  Edges edges;
  for (int i = 1; i < vertices; ++i)
    edges.emplace_back(name[at(i)], name[at(i - 1 - draw(std::min(reach, i), seed + 1000 + i))]);
  return edges;
}

/// A graph in which vertex i > 1 halves an edge, runs beside an edge, or hangs on an earlier vertex.  The vertices are
/// then shuffled.
inline Edges random_series_parallel(int vertices, int seed) {
  const std::vector<int> name = shuffled(vertices, seed);
  Edges edges{{0, 1}};
  for (int i = 2; i < vertices; ++i) {
    const int kind = draw(7, seed + 2000 + i);
    const std::size_t e = at(draw(static_cast<int>(edges.size()), seed + 3000 + i));
    const auto [a, b] = edges[e];
    edges.emplace_back(a, i);
    if (kind < 6) edges.emplace_back(i, b);
    if (kind < 3) edges.erase(edges.begin() + static_cast<long>(e));
  }
  for (auto& [a, b] : edges) a = name[at(a)], b = name[at(b)];
  return edges;
}

/// `count` pairs of different vertices, some of them more than once.
inline Edges random_pairs(int vertices, int count, int seed) {
  Edges edges;
  for (int i = 0; i < count; ++i) {
    const int a = draw(vertices, seed + 2 * i), b = draw(vertices, seed + 2 * i + 1);
    if (a != b) edges.emplace_back(a, b);
  }
  return edges;
}

inline Edges grid(int side) {
  Edges edges;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      if (i + 1 < side) edges.emplace_back(i * side + j, (i + 1) * side + j);
      if (j + 1 < side) edges.emplace_back(i * side + j, i * side + j + 1);
    }
  return edges;
}

}   // namespace cablenet::test
