#include <mpi.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>

#include "cablenet/elimination/elimination.hpp"
#include "cablenet/partition/cut.hpp"

/// This program measures what substructuring would cost on any number of ranks, without the ranks.  It cuts an array's
/// graph.  Then it factors and solves the part that takes most work, and the interface, on one core.
namespace {

using cablenet::at;
using cablenet::elimination::BlockGraph;
using cablenet::elimination::Elimination;
using cablenet::partition::Graph;

/// An array: half the nodes are on a trunk, and the others are on branches at equal distances.
Graph array(int nodes, int branches) {
  const int trunk = branches > 0 ? nodes / 2 : nodes, length = branches > 0 ? (nodes - trunk) / branches : 0;
  std::vector<std::pair<int, int>> edges;
  for (int i = 1; i < trunk; ++i) edges.emplace_back(i - 1, i);
  for (int b = 0; b < branches; ++b)
    for (int i = 0; i < length; ++i) {
      const int node = trunk + b * length + i;
      edges.emplace_back(i == 0 ? static_cast<int>((2L * b + 1) * trunk / (2L * branches)) : node - 1, node);
    }
  Graph graph;
  graph.first.assign(at(trunk + branches * length) + 1, 0);
  for (const auto& [a, b] : edges) ++graph.first[at(a) + 1], ++graph.first[at(b) + 1];
  std::partial_sum(graph.first.begin(), graph.first.end(), graph.first.begin());
  graph.adjacent.resize(2 * edges.size());
  std::vector<int> next(graph.first.begin(), graph.first.end() - 1);
  for (const auto& [a, b] : edges) {
    graph.adjacent[at(next[at(a)]++)] = b;
    graph.adjacent[at(next[at(b)]++)] = a;
  }
  return graph;
}

/// The vertices of a part in the order of elimination, followed by the kept ones.  The blocks are like those of a
/// chain.
struct System {
  std::vector<int> order;
  int eliminated;
  std::unique_ptr<Elimination> elimination;
  double updates;
  std::vector<double> matrix, w, kept;

  System(const Graph& graph, std::vector<int> vertices, const std::vector<bool>& is_kept) {
    const Graph part = cablenet::partition::subgraph(graph, vertices);
    std::vector<bool> stays;
    for (const int v : vertices) stays.push_back(is_kept[at(v)]);
    order = cablenet::partition::elimination_order(part, stays);
    eliminated = static_cast<int>(order.size());
    for (int v = 0; v < part.vertices(); ++v)
      if (stays[at(v)]) order.push_back(v);
    BlockGraph coupled{std::vector<int>(order.size(), 3), eliminated, {0}, {}};
    const Graph sorted = cablenet::partition::subgraph(part, order);
    coupled.first = sorted.first;
    coupled.first.resize(at(eliminated) + 1);
    coupled.adjacent = sorted.adjacent;
    fill_matrix(sorted);
    auto plan = *cablenet::elimination::make_plan(coupled, false);
    updates = plan.updates;
    elimination = std::make_unique<Elimination>(std::move(plan), [&](int i, int j) { return source(sorted, i, j); });
    w.assign(3 * at(eliminated), 1);
    kept.assign(3 * (order.size() - at(eliminated)), 0);
  }

  /// For each row, the diagonal block comes first, then its neighbours' blocks.
  void fill_matrix(const Graph& graph) {
    for (int v = 0; v < graph.vertices(); ++v)
      for (int k = -1; k < graph.first[at(v) + 1] - graph.first[at(v)]; ++k)
        for (int entry = 0; entry < 9; ++entry)
          matrix.push_back(entry % 4 != 0 ? 0.1 : k < 0 ? 3.0 + graph.first[at(v) + 1] - graph.first[at(v)] : -1.0);
  }
  static cablenet::elimination::BlockSource source(const Graph& graph, int i, int j) {
    const auto begin = graph.adjacent.begin() + graph.first[at(i)],
               end = graph.adjacent.begin() + graph.first[at(i) + 1];
    const auto found = std::find(begin, end, j);
    if (i != j && found == end) return {};
    const int behind = i == j ? 0 : static_cast<int>(found - begin) + 1;
    return cablenet::elimination::block_source(9 * (graph.first[at(i)] + i + behind), 3, 0);
  }

  /// The time for factoring and solving, the least of several measurements.  [s]
  double seconds() {
    double least = 1e300;
    for (int repetition = 0; repetition < 5; ++repetition) {
      const double start = MPI_Wtime();
      if (elimination->factor({matrix.data(), nullptr, nullptr}).singular >= 0) throw std::runtime_error("singular");
      elimination->forward(w.data(), kept.data());
      elimination->backward(w.data(), kept.data());
      least = std::min(least, MPI_Wtime() - start);
    }
    return least;
  }
};

/// The vertices of each part, and the interface vertices next to them.
std::vector<std::vector<int>> members(const Graph& graph, const std::vector<int>& part, const std::vector<bool>& shared,
                                      int parts) {
  std::vector<std::vector<int>> members(at(parts));
  for (int v = 0; v < graph.vertices(); ++v)
    if (!shared[at(v)])
      members[at(part[at(v)])].push_back(v);
    else
      for (int k = graph.first[at(v)]; k < graph.first[at(v) + 1]; ++k)
        if (const int w = graph.adjacent[at(k)]; !shared[at(w)]) {
          auto& list = members[at(part[at(w)])];
          if (list.empty() || list.back() != v) list.push_back(v);
        }
  for (auto& list : members) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return members;
}

void measure(int nodes, int branches, int parts) {
  const Graph graph = array(nodes, branches);
  const double start = MPI_Wtime();
  const std::vector<int> part = cablenet::partition::cut_network(graph, parts);
  const double cut = MPI_Wtime() - start;
  const std::vector<bool> shared = cablenet::partition::find_interface(graph, part);
  const Graph coupled = cablenet::partition::interface_graph(graph, shared);
  const std::vector<int> cost = cablenet::partition::step_cost(graph, shared);
  std::vector<long> total(at(parts), 0);
  for (int v = 0; v < graph.vertices(); ++v) total[at(part[at(v)])] += cost[at(v)];
  const auto largest = std::max_element(total.begin(), total.end()) - total.begin();
  System mine(graph, members(graph, part, shared, parts)[static_cast<std::size_t>(largest)], shared);
  std::vector<int> all(at(coupled.vertices()));
  std::iota(all.begin(), all.end(), 0);
  System interface(coupled, all, std::vector<bool>(all.size(), false));
  const double doubles = 9.0 * (coupled.adjacent.size() + all.size()) + 3.0 * all.size() + 1;
  std::printf(
      "parts=%d nodes=%d part_nodes=%d products_per_node=%.2f part_us=%.1f interface_nodes=%d interface_us=%.1f "
      "sum_kB=%.1f cut_seconds=%.2f\n",
      parts, graph.vertices(), mine.eliminated, mine.updates / std::max(1, mine.eliminated), 1e6 * mine.seconds(),
      coupled.vertices(), 1e6 * interface.seconds(), 8e-3 * doubles, cut);
}

}   // namespace

int main(int count, char** words) {
  if (count < 4) {
    std::fputs("usage: yardstick_parts NODES BRANCHES PARTS...\n", stderr);
    return 2;
  }
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  MPI_Init(&count, &words);
  for (int i = 3; i < count; ++i) measure(std::atoi(words[1]), std::atoi(words[2]), std::atoi(words[i]));
  MPI_Finalize();
  return 0;
}
