#include "cablenet/partition/cut.hpp"

#include <metis.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <queue>
#include <stdexcept>
#include <utility>

#include "cablenet/base/index.hpp"

namespace cablenet::partition {
namespace {

/// A graph in the form that METIS takes.
class Cutter {
public:
  explicit Cutter(const Graph& graph)
      : first_(graph.first.begin(), graph.first.end()), adjacent_(graph.adjacent.begin(), graph.adjacent.end()) {
    const std::vector<int> piece = connected_pieces(graph);
    connected_ = std::all_of(piece.begin(), piece.end(), [](int number) { return number == 0; });
  }

  enum class Way { direct, recursive, branches };

  /// The ways of cutting that are worth a try.  The direct way keeps a part in one piece.  The recursive way balances
  /// parts of few vertices or heavy branches.  The way `branches` takes whole branches off hubs.  Edges at a hub count
  /// for little there, because the hub alone becomes interface.
  std::vector<Way> ways(int parts) const {
    const bool large = first_.size() > at(least_for_direct) * at(parts);
    return large ? std::vector<Way>{Way::direct, Way::recursive, Way::branches}
                 : std::vector<Way>{Way::recursive, Way::branches};
  }

  std::vector<int> cut(const std::vector<int>& weight, int parts, Way way) {
    std::vector<idx_t> weights(weight.begin(), weight.end()), result(weight.size());
    idx_t vertices = static_cast<idx_t>(weight.size());
    idx_t constraints = 1;
    idx_t wanted = parts;
    idx_t edges_cut = 0;
    idx_t options[METIS_NOPTIONS];
    METIS_SetDefaultOptions(options);
    options[METIS_OPTION_SEED] = 1;
    options[METIS_OPTION_UFACTOR] = thousandths_over_average;
    if (way == Way::direct && connected_) options[METIS_OPTION_CONTIG] = 1;
    std::vector<idx_t> edges = way == Way::branches ? edge_weights() : std::vector<idx_t>{};
    const int status = (way == Way::direct ? METIS_PartGraphKway : METIS_PartGraphRecursive)(
        &vertices, &constraints, first_.data(), adjacent_.data(), weights.data(), nullptr,
        edges.empty() ? nullptr : edges.data(), &wanted, nullptr, nullptr, options, &edges_cut, result.data());
    if (status != METIS_OK) throw std::runtime_error("METIS could not cut the network into parts");
    return {result.begin(), result.end()};
  }

private:
  /// The weight of an edge is in inverse proportion to the number of edges at the end that has more of them.
  std::vector<idx_t> edge_weights() const {
    constexpr idx_t heaviest = 64;
    std::vector<idx_t> weights;
    weights.reserve(adjacent_.size());
    const auto degree = [this](idx_t v) {
      return first_[static_cast<std::size_t>(v) + 1] - first_[static_cast<std::size_t>(v)];
    };
    for (std::size_t v = 0; v + 1 < first_.size(); ++v)
      for (idx_t k = first_[v]; k < first_[v + 1]; ++k)
        weights.push_back(std::max<idx_t>(
            1, heaviest / std::max(degree(static_cast<idx_t>(v)), degree(adjacent_[static_cast<std::size_t>(k)]))));
    return weights;
  }

  static constexpr int least_for_direct = 100;   ///< vertices per part
  static constexpr idx_t thousandths_over_average = 3;

  std::vector<idx_t> first_;
  std::vector<idx_t> adjacent_;
  bool connected_;
};

/// Cuts repeatedly, each time with the costs that the last cut has brought about, and keeps the best cut.
class Search {
public:
  Search(const Graph& graph, int parts, const std::vector<int>& work)
      : graph_(graph), parts_(parts), work_(work), cutter_(graph) {}

  std::vector<int> run() {
    const auto ways = cutter_.ways(parts_);
    const std::vector<int> first = work_.empty() ? std::vector<int>(at(graph_.vertices()), 1) : work_;
    if (count_loops(graph_) > loops_of_net) return cutter_.cut(first, parts_, ways.front());
    // Two parts of a tree have the interface on one side alone, so no vertex costs more after the first cut.
    const int cuts = parts_ == 2 ? 1 : most_cuts;
    for (const auto way : ways) {
      std::vector<int> cost = first;
      for (int repetition = 0; repetition < cuts; ++repetition) cost = try_cut(cutter_.cut(cost, parts_, way));
      if (imbalance_ < good_imbalance) break;
    }
    return std::move(best_);
  }

private:
  /// A graph with more loops than this counts as a net: nearly all of its vertices get fill, wherever it is cut.
  static constexpr int loops_of_net = 100;
  static constexpr int most_cuts = 4;
  static constexpr double good_imbalance = 1.02;   ///< cost of the most expensive part over the average

  /// @returns the cost of every vertex
  std::vector<int> try_cut(std::vector<int> part) {
    const std::vector<bool> interface = find_interface(graph_, part);
    std::vector<int> cost = step_cost(graph_, interface, work_);
    std::vector<long> sums(at(parts_), 0);
    for (std::size_t v = 0; v < part.size(); ++v) sums[at(part[v])] += cost[v];
    const long largest = *std::max_element(sums.begin(), sums.end());
    // Every rank solves for the whole interface.
    const long shared = std::count(interface.begin(), interface.end(), true);
    const std::pair<long, long> found{largest + usual_cost * shared, shared};
    if (found < lowest_) {
      lowest_ = found;
      imbalance_ =
          static_cast<double>(largest * parts_) / static_cast<double>(std::accumulate(sums.begin(), sums.end(), 0L));
      best_ = std::move(part);
    }
    return cost;
  }

  const Graph& graph_;
  int parts_;
  const std::vector<int>& work_;
  Cutter cutter_;
  std::vector<int> best_;
  std::pair<long, long> lowest_{std::numeric_limits<long>::max(),
                                0};   ///< the best cut's cost of the busiest rank, and its interface vertices
  double imbalance_ = std::numeric_limits<double>::max();
};

}   // namespace

std::vector<int> cut_network(const Graph& graph, int parts, const std::vector<int>& work) {
  std::vector<int> part(at(graph.vertices()), 0);
  if (parts == 1) return part;
  if (parts < graph.vertices()) return Search(graph, parts, work).run();
  std::iota(part.begin(), part.end(), 0);
  return part;
}

std::vector<bool> find_interface(const Graph& graph, const std::vector<int>& part) {
  std::vector<bool> interface(part.size(), false);
  const auto open_edges = [&](int v) {
    int count = 0;
    for (int k = graph.first[at(v)]; k < graph.first[at(v) + 1]; ++k)
      count += part[at(graph.adjacent[at(k)])] != part[at(v)] && !interface[at(graph.adjacent[at(k)])];
    return count;
  };
  std::priority_queue<std::pair<int, int>> queue;
  for (int v = 0; v < graph.vertices(); ++v)
    if (const int edges = open_edges(v); edges > 0) queue.emplace(edges, -v);
  std::vector<int> chosen;
  while (!queue.empty()) {
    const auto [edges, minus_v] = queue.top();
    queue.pop();
    const int left = open_edges(-minus_v);
    if (left == edges) {
      interface[at(-minus_v)] = true;
      chosen.push_back(-minus_v);
    } else if (left > 0) {
      queue.emplace(left, minus_v);
    }
  }
  for (const int v : chosen) interface[at(v)] = open_edges(v) > 0;
  return interface;
}

std::vector<int> step_cost(const Graph& graph, const std::vector<bool>& interface, const std::vector<int>& work) {
  const std::vector<bool> stays = unpeeled(graph, interface);
  std::vector<int> cost(interface.size());
  for (std::size_t v = 0; v < cost.size(); ++v) {
    cost[v] = stays[v] && !interface[v] ? filled_cost : usual_cost;
    if (!work.empty()) cost[v] *= work[v];
  }
  return cost;
}

namespace {

/// The most pairs of an interface graph: eliminating more would never be worth it.
constexpr double most_pairs = 1e8;

}   // namespace

Graph interface_graph(const Graph& graph, const std::vector<bool>& interface) {
  const std::vector<int> piece = connected_pieces(graph, interface);
  std::vector<int> index(interface.size(), -1), vertices;
  std::vector<std::vector<int>> around(piece.empty() ? 0 : at(1 + *std::max_element(piece.begin(), piece.end())));
  const auto for_each_neighbour = [&](int v, auto&& visit) {
    for (int k = graph.first[at(v)]; k < graph.first[at(v) + 1]; ++k) visit(graph.adjacent[at(k)]);
  };
  for (int v = 0; v < graph.vertices(); ++v) {
    if (!interface[at(v)]) continue;
    const int i = index[at(v)] = static_cast<int>(vertices.size());
    vertices.push_back(v);
    for_each_neighbour(v, [&](int w) {
      if (piece[at(w)] < 0) return;
      std::vector<int>& ring = around[at(piece[at(w)])];
      if (ring.empty() || ring.back() != i) ring.push_back(i);
    });
  }
  const double pairs = std::accumulate(around.begin(), around.end(), 0.0, [](double sum, const auto& ring) {
    return sum + static_cast<double>(ring.size()) * static_cast<double>(ring.size());
  });
  if (pairs > most_pairs) return {};
  std::vector<int> met(vertices.size(), -1), visited(around.size(), -1);
  Graph coupled;
  coupled.first.push_back(0);
  for (int i = 0; i < static_cast<int>(vertices.size()); ++i) {
    const auto couple = [&](int j) {
      if (j != i && std::exchange(met[at(j)], i) != i) coupled.adjacent.push_back(j);
    };
    for_each_neighbour(vertices[at(i)], [&](int w) {
      if (interface[at(w)])
        couple(index[at(w)]);
      else if (std::exchange(visited[at(piece[at(w)])], i) != i)
        for (const int j : around[at(piece[at(w)])]) couple(j);
    });
    coupled.first.push_back(static_cast<int>(coupled.adjacent.size()));
  }
  return coupled;
}

}   // namespace cablenet::partition
