#include "cablenet/partition/partition.hpp"

#include <metis.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace cablenet::partition {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// The graph whose vertices are the nodes with vertex[node] >= 0 and whose edges are the elements between them.
Graph node_graph(const network::Network& network, const std::vector<int>& vertex, int vertices) {
  Graph graph;
  graph.first.assign(at(vertices) + 1, 0);
  const auto for_each_edge = [&](auto&& visit) {
    for (const auto& element : network.elements) {
      const int a = vertex[at(element.node[0])];
      const int b = vertex[at(element.node[1])];
      if (a >= 0 && b >= 0 && a != b) visit(a, b);
    }
  };
  for_each_edge([&](int a, int b) { ++graph.first[at(a) + 1], ++graph.first[at(b) + 1]; });
  std::partial_sum(graph.first.begin(), graph.first.end(), graph.first.begin());
  graph.adjacent.resize(at(graph.first.back()));
  std::vector<int> next(graph.first.begin(), graph.first.end() - 1);
  for_each_edge([&](int a, int b) {
    graph.adjacent[at(next[at(a)]++)] = b;
    graph.adjacent[at(next[at(b)]++)] = a;
  });
  return graph;
}

std::vector<idx_t> as_metis(const std::vector<int>& values) { return {values.begin(), values.end()}; }

std::vector<int> cut(const Graph& graph, int parts) {
  const int vertices = static_cast<int>(graph.first.size()) - 1;
  std::vector<int> part(at(vertices), 0);
  if (parts == 1) return part;
  if (parts >= vertices) {
    std::iota(part.begin(), part.end(), 0);
    return part;
  }
  std::vector<idx_t> first = as_metis(graph.first);
  std::vector<idx_t> adjacent = as_metis(graph.adjacent);
  std::vector<idx_t> result(at(vertices));
  idx_t count = vertices;
  idx_t constraints = 1;
  idx_t wanted = parts;
  idx_t edges_cut = 0;
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  const int status = METIS_PartGraphKway(&count, &constraints, first.data(), adjacent.data(), nullptr, nullptr, nullptr,
                                         &wanted, nullptr, nullptr, options, &edges_cut, result.data());
  if (status != METIS_OK) throw std::runtime_error("METIS could not cut the network into parts");
  std::copy(result.begin(), result.end(), part.begin());
  return part;
}

std::vector<int> dissect(const Graph& graph) {
  idx_t vertices = static_cast<idx_t>(graph.first.size()) - 1;
  std::vector<idx_t> first = as_metis(graph.first);
  std::vector<idx_t> adjacent = as_metis(graph.adjacent);
  std::vector<idx_t> order(at(vertices)), position(at(vertices));
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  if (METIS_NodeND(&vertices, first.data(), adjacent.data(), nullptr, options, order.data(), position.data()) !=
      METIS_OK)
    throw std::runtime_error("METIS could not order the network");
  return {order.begin(), order.end()};
}

/// The subgraph on `vertices`; `position` is scratch, all -1 and left so.
Graph subgraph(const Graph& graph, const std::vector<int>& vertices, std::vector<int>& position) {
  for (std::size_t i = 0; i < vertices.size(); ++i) position[at(vertices[i])] = static_cast<int>(i);
  Graph part;
  part.first.push_back(0);
  for (const int v : vertices) {
    for (int k = graph.first[at(v)]; k < graph.first[at(v) + 1]; ++k)
      if (position[at(graph.adjacent[at(k)])] >= 0) part.adjacent.push_back(position[at(graph.adjacent[at(k)])]);
    part.first.push_back(static_cast<int>(part.adjacent.size()));
  }
  for (const int v : vertices) position[at(v)] = -1;
  return part;
}

std::vector<int> all_orders(const std::vector<int>& mine, int vertices, MPI_Comm communicator) {
  int ranks = 1;
  MPI_Comm_size(communicator, &ranks);
  std::vector<int> counts(at(ranks)), offsets(at(ranks) + 1, 0);
  const int count = static_cast<int>(mine.size());
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, communicator);
  std::partial_sum(counts.begin(), counts.end(), offsets.begin() + 1);
  std::vector<int> all(at(vertices));
  MPI_Allgatherv(mine.data(), count, MPI_INT, all.data(), counts.data(), offsets.data(), MPI_INT, communicator);
  return all;
}

/// Edges - vertices + connected pieces.
int count_loops(const Graph& graph) {
  const int vertices = static_cast<int>(graph.first.size()) - 1;
  std::vector<bool> seen(at(vertices), false);
  std::vector<int> front;
  int pieces = 0;
  for (int seed = 0; seed < vertices; ++seed) {
    if (seen[at(seed)]) continue;
    ++pieces;
    seen[at(seed)] = true;
    for (front.assign(1, seed); !front.empty();) {
      const int v = front.back();
      front.pop_back();
      for (int k = graph.first[at(v)]; k < graph.first[at(v) + 1]; ++k) {
        const int neighbour = graph.adjacent[at(k)];
        if (!seen[at(neighbour)]) front.push_back(neighbour);
        seen[at(neighbour)] = true;
      }
    }
  }
  return static_cast<int>(graph.adjacent.size() / 2) - vertices + pieces;
}

/// @param order vertices, rank after rank   @param part of every vertex
void number_nodes(const std::vector<int>& order, const std::vector<int>& free_nodes, const std::vector<int>& part,
                  int ranks, std::size_t nodes, Partition& partition) {
  partition.node_owner.assign(nodes, 0);
  partition.solver_number.assign(nodes, -1);
  partition.first_number.assign(at(ranks) + 1, 0);
  int number = 0;
  for (const int v : order) {
    const int node = free_nodes[at(v)];
    partition.node_owner[at(node)] = part[at(v)];
    partition.solver_number[at(node)] = number++;
    partition.first_number[at(part[at(v)]) + 1] = number;
  }
  for (std::size_t r = 1; r < partition.first_number.size(); ++r)
    partition.first_number[r] = std::max(partition.first_number[r], partition.first_number[r - 1]);
}

void assign_elements(const network::Network& network, Partition& partition) {
  // An element without free nodes goes to a rank that has rows, so that every rank with elements has a voice in norms.
  const auto first_rank = std::upper_bound(partition.first_number.begin(), partition.first_number.end(), 0);
  const int otherwise = static_cast<int>(first_rank - partition.first_number.begin()) - 1;
  std::vector<int> degree(network.position.size(), 0);
  for (const auto& element : network.elements)
    for (const int node : element.node) ++degree[at(node)];
  for (const auto& held : network.prescribed) degree[at(held.node)] = 0;
  // All elements at a branching node on one rank: its forces are then summed in the same order on any number of ranks.
  partition.element_owner.reserve(network.elements.size());
  for (const auto& [node, material, length] : network.elements) {
    const int busier = degree[at(node[1])] > degree[at(node[0])] ? node[1] : node[0];
    partition.element_owner.push_back(degree[at(busier)] > 0 ? partition.node_owner[at(busier)] : otherwise);
  }
  std::vector<bool> taken(network.position.size(), false);
  for (std::size_t i = 0; i < network.elements.size(); ++i)
    for (const int node : network.elements[i].node)
      if (partition.solver_number[at(node)] < 0 && !taken[at(node)]) {
        taken[at(node)] = true;
        partition.node_owner[at(node)] = partition.element_owner[i];
      }
}

}   // namespace

std::vector<int> elimination_order(const Graph& graph) {
  const int vertices = static_cast<int>(graph.first.size()) - 1;
  std::vector<int> degree(at(vertices)), order;
  std::vector<bool> gone(at(vertices), false);
  order.reserve(at(vertices));
  for (int v = 0; v < vertices; ++v) degree[at(v)] = graph.first[at(v) + 1] - graph.first[at(v)];
  for (int leaf = 0; leaf < vertices; ++leaf)
    for (int v = leaf; v >= 0 && !gone[at(v)] && degree[at(v)] <= 1;) {
      gone[at(v)] = true;
      order.push_back(v);
      int parent = -1;
      for (int k = graph.first[at(v)]; k < graph.first[at(v) + 1]; ++k)
        if (!gone[at(graph.adjacent[at(k)])]) parent = graph.adjacent[at(k)];
      if (parent >= 0) --degree[at(parent)];
      v = parent;
    }
  std::vector<int> core;
  for (int v = 0; v < vertices; ++v)
    if (!gone[at(v)]) core.push_back(v);
  if (core.empty()) return order;
  std::vector<int> scratch(at(vertices), -1);
  for (const int k : dissect(subgraph(graph, core, scratch))) order.push_back(core[at(k)]);
  return order;
}

Partition make_partition(const network::Network& network, MPI_Comm communicator) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &ranks);
  std::vector<int> vertex(network.position.size(), 0), free_nodes;
  for (const auto& held : network.prescribed) vertex[at(held.node)] = -1;
  for (std::size_t i = 0; i < vertex.size(); ++i)
    if (vertex[i] == 0) {
      vertex[i] = static_cast<int>(free_nodes.size());
      free_nodes.push_back(static_cast<int>(i));
    }
  const int vertices = static_cast<int>(free_nodes.size());
  const Graph graph = node_graph(network, vertex, vertices);
  std::vector<int> part = rank == 0 ? cut(graph, ranks) : std::vector<int>(at(vertices));
  MPI_Bcast(part.data(), vertices, MPI_INT, 0, communicator);

  std::vector<int> mine, scratch(at(vertices), -1);
  for (int v = 0; v < vertices; ++v)
    if (part[at(v)] == rank) mine.push_back(v);
  std::vector<int> order = elimination_order(subgraph(graph, mine, scratch));
  for (int& k : order) k = mine[at(k)];

  Partition partition;
  number_nodes(all_orders(order, vertices, communicator), free_nodes, part, ranks, vertex.size(), partition);
  partition.loops = count_loops(graph);
  if (partition.loops <= few_loops)
    for (const int v : elimination_order(graph))
      partition.elimination.push_back(partition.solver_number[at(free_nodes[at(v)])]);
  assign_elements(network, partition);
  return partition;
}

}   // namespace cablenet::partition
