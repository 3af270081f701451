#include "cablenet/partition/graph.hpp"

#include <metis.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "cablenet/base/index.hpp"

namespace cablenet::partition {
namespace {

std::vector<int> dissect(const Graph& graph) {
  idx_t vertices = graph.vertices();
  std::vector<idx_t> first(graph.first.begin(), graph.first.end());
  std::vector<idx_t> adjacent(graph.adjacent.begin(), graph.adjacent.end());
  std::vector<idx_t> order(at(vertices)), position(at(vertices));
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  if (METIS_NodeND(&vertices, first.data(), adjacent.data(), nullptr, options, order.data(), position.data()) !=
      METIS_OK)
    throw std::runtime_error("METIS could not order the network");
  return {order.begin(), order.end()};
}

/// A graph that shrinks as vertices with at most two neighbours are eliminated.  Such an elimination makes no neighbour
/// list longer, so it takes place in the lists themselves.  `twin_` leads from an entry of a list to the entry for the
/// same edge in the list of the other end.
class OrderFinder {
public:
  OrderFinder(const Graph& graph, const std::vector<bool>& kept)
      : graph_(simple_graph(graph)), twin_(graph_.adjacent.size()), degree_(at(graph_.vertices()), 0), held_(kept) {
    held_.resize(degree_.size(), false);
    order_.reserve(degree_.size());
    // Neighbours are in ascending order, so a vertex is already paired with the smaller ones when its turn comes.
    for (int v = 0; v < graph_.vertices(); ++v)
      for (int k = graph_.first[at(v)] + degree_[at(v)]; k < graph_.first[at(v) + 1]; ++k, ++degree_[at(v)])
        pair(k, graph_.first[at(graph_.adjacent[at(k)])] + degree_[at(graph_.adjacent[at(k)])]++);
  }

  /// Peels leaves along two cables in turns.  The work on one cable does not wait for the other's, so a processor can
  /// overlap the two.
  void peel_leaves() {
    std::array<int, 2> fronts{-1, -1};
    int seed = 0;
    bool going = true;
    while (going) {
      going = false;
      for (int& front : fronts) {
        while (!can_peel(front) && seed < graph_.vertices()) front = seed++;
        if (!can_peel(front)) continue;
        front = peel(front);
        going = true;
      }
    }
  }

  void contract_paths() {
    std::vector<int> freed;
    for (int seed = 0; seed < graph_.vertices(); ++seed)
      for (freed.assign(1, seed); !freed.empty();) {
        const int v = peel_from(freed.back());
        freed.pop_back();
        if (v >= 0 && may_go(v, 2)) contract_path(v, freed);
      }
  }

  void dissect_rest() {
    std::vector<int> rest;
    for (int v = 0; v < graph_.vertices(); ++v)
      if (!held_[at(v)]) rest.push_back(v);
    if (rest.empty()) return;
    Graph left;
    left.first.push_back(0);
    for (int v = 0; v < graph_.vertices(); ++v) {
      for (int side = 0; side < degree_[at(v)]; ++side) left.adjacent.push_back(neighbour(v, side));
      left.first.push_back(static_cast<int>(left.adjacent.size()));
    }
    left = subgraph(left, rest);
    if (left.adjacent.empty())
      order_.insert(order_.end(), rest.begin(), rest.end());
    else
      for (const int k : dissect(left)) order_.push_back(rest[at(k)]);
  }

  std::vector<int> take_order() { return std::move(order_); }

private:
  bool may_go(int v, int most_neighbours) const { return !held_[at(v)] && degree_[at(v)] <= most_neighbours; }
  int neighbour(int v, int side) const { return graph_.adjacent[at(graph_.first[at(v)] + side)]; }

  void pair(int entry, int other) {
    twin_[at(entry)] = other;
    twin_[at(other)] = entry;
  }

  void swap_entries(int one, int other) {
    std::swap(graph_.adjacent[at(one)], graph_.adjacent[at(other)]);
    std::swap(twin_[at(one)], twin_[at(other)]);
    pair(one, twin_[at(one)]);
    pair(other, twin_[at(other)]);
  }

  void remove_entry(int v, int entry) { swap_entries(entry, graph_.first[at(v)] + --degree_[at(v)]); }

  bool are_joined(int a, int b) {
    if (degree_[at(a)] > degree_[at(b)]) std::swap(a, b);
    for (int side = 0; side < degree_[at(a)]; ++side)
      if (neighbour(a, side) == b) {
        // The edge moves to the front, where the next of many paths between the same two vertices finds it at once.
        swap_entries(graph_.first[at(a)] + side, graph_.first[at(a)]);
        return true;
      }
    return false;
  }

  void eliminate(int v) {
    order_.push_back(v);
    held_[at(v)] = true;
    const int one = graph_.first[at(v)], other = one + 1;
    const int a = degree_[at(v)] > 0 ? neighbour(v, 0) : -1, b = degree_[at(v)] > 1 ? neighbour(v, 1) : -1;
    if (b >= 0 && !are_joined(a, b)) {
      graph_.adjacent[at(twin_[at(one)])] = b;
      graph_.adjacent[at(twin_[at(other)])] = a;
      pair(twin_[at(one)], twin_[at(other)]);
      return;
    }
    if (a >= 0) remove_entry(a, twin_[at(one)]);
    if (b >= 0) remove_entry(b, twin_[at(other)]);
  }

  int beyond(int v, int behind) const {
    for (int side = 0; side < degree_[at(v)]; ++side)
      if (neighbour(v, side) != behind) return neighbour(v, side);
    return -1;
  }

  bool can_peel(int v) const { return v >= 0 && may_go(v, 1); }

  /// @returns the vertex at which the leaf hung, or -1
  int peel(int leaf) {
    const int parent = beyond(leaf, -1);
    eliminate(leaf);
    return parent;
  }

  /// Peels leaves, one after the other, along the cable that begins at `leaf`.
  /// @returns the vertex at which the peeling ends, or -1
  int peel_from(int leaf) {
    int v = leaf;
    while (can_peel(v)) v = peel(v);
    return v;
  }

  /// Eliminates the path through `seed` from end to end, and the vertices ahead that become eliminable by that.
  /// @param freed  gets the vertices that may have become eliminable
  void contract_path(int seed, std::vector<int>& freed) {
    int v = seed, behind = neighbour(seed, 0);
    while (behind >= 0 && behind != seed && may_go(behind, 2)) {
      const int further = beyond(behind, v);
      v = behind;
      behind = further;
    }
    while (v >= 0 && may_go(v, behind >= 0 ? 2 : 1)) {
      const int ahead = beyond(v, behind);
      eliminate(v);
      v = ahead;
    }
    for (const int end : {behind, v})
      if (end >= 0) freed.push_back(end);
  }

  Graph graph_;
  std::vector<int> twin_;
  std::vector<int> degree_;
  std::vector<bool> held_;   ///< kept, or eliminated already
  std::vector<int> order_;
};

}   // namespace

Graph simple_graph(const Graph& graph) {
  const int vertices = graph.vertices();
  std::vector<int> last(at(vertices), -1);
  Graph simple;
  simple.first.assign(at(vertices) + 1, 0);
  const auto for_each_pair = [&](auto&& visit) {
    std::fill(last.begin(), last.end(), -1);
    for (int v = 0; v < vertices; ++v)
      for (int k = graph.first[at(v)]; k < graph.first[at(v) + 1]; ++k) {
        const int w = graph.adjacent[at(k)];
        if (w != v && std::exchange(last[at(w)], v) != v) visit(w, v);
      }
  };
  for_each_pair([&](int w, int) { ++simple.first[at(w) + 1]; });
  std::partial_sum(simple.first.begin(), simple.first.end(), simple.first.begin());
  simple.adjacent.resize(at(simple.first.back()));
  std::vector<int> next(simple.first.begin(), simple.first.end() - 1);
  for_each_pair([&](int w, int v) { simple.adjacent[at(next[at(w)]++)] = v; });
  return simple;
}

Graph subgraph(const Graph& graph, const std::vector<int>& vertices) {
  std::vector<int> position(at(graph.vertices()), -1);
  for (std::size_t i = 0; i < vertices.size(); ++i) position[at(vertices[i])] = static_cast<int>(i);
  Graph part;
  part.first.reserve(vertices.size() + 1);
  part.first.push_back(0);
  for (const int v : vertices) {
    for (int k = graph.first[at(v)]; k < graph.first[at(v) + 1]; ++k)
      if (const int other = position[at(graph.adjacent[at(k)])]; other >= 0) part.adjacent.push_back(other);
    part.first.push_back(static_cast<int>(part.adjacent.size()));
  }
  return part;
}

std::vector<int> connected_pieces(const Graph& graph, const std::vector<bool>& barred) {
  std::vector<int> piece(at(graph.vertices()), -1), front;
  int pieces = 0;
  const auto enter = [&](int v) {
    if (piece[at(v)] >= 0 || (!barred.empty() && barred[at(v)])) return;
    piece[at(v)] = pieces;
    front.push_back(v);
  };
  for (int seed = 0; seed < graph.vertices(); ++seed) {
    enter(seed);
    if (front.empty()) continue;
    while (!front.empty()) {
      const int v = front.back();
      front.pop_back();
      for (int k = graph.first[at(v)]; k < graph.first[at(v) + 1]; ++k) enter(graph.adjacent[at(k)]);
    }
    ++pieces;
  }
  return piece;
}

int count_loops(const Graph& graph) {
  const std::vector<int> piece = connected_pieces(graph);
  const int pieces = piece.empty() ? 0 : 1 + *std::max_element(piece.begin(), piece.end());
  return static_cast<int>(graph.adjacent.size() / 2) - graph.vertices() + pieces;
}

std::vector<int> elimination_order(const Graph& graph, const std::vector<bool>& kept) {
  OrderFinder finder(graph, kept);
  finder.peel_leaves();
  finder.contract_paths();
  finder.dissect_rest();
  return finder.take_order();
}

std::vector<bool> unpeeled(const Graph& graph, const std::vector<bool>& kept) {
  OrderFinder finder(graph, kept);
  finder.peel_leaves();
  std::vector<bool> stays(at(graph.vertices()), true);
  for (const int v : finder.take_order()) stays[at(v)] = false;
  return stays;
}

}   // namespace cablenet::partition
