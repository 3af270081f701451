#include "cablenet/partition/partition.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "cablenet/bodies/rigid_body.hpp"
#include "cablenet/partition/cut.hpp"

namespace cablenet::partition {
namespace {

/// The nodes that have unknowns of their own.  They are the vertices of the graph.
struct FreeNodes {
  std::vector<SceneNode> node;    ///< per vertex
  Table<SceneNode, int> vertex;   ///< per node: its own vertex, or its body's if it is carried; -1 if prescribed
};

FreeNodes find_free_nodes(const network::Network& network) {
  FreeNodes free{{}, Table<SceneNode, int>(network.position.size(), 0)};
  for (const auto& held : network.prescribed) free.vertex[held.node] = -1;
  for (const auto& carried : network.carried) free.vertex[carried.node] = -1;
  for (SceneNode node(0); node.value() < free.vertex.size(); ++node)
    if (free.vertex[node] == 0) {
      free.vertex[node] = static_cast<int>(free.node.size());
      free.node.push_back(node);
    }
  for (const auto& carried : network.carried)
    free.vertex[carried.node] = free.vertex[network.bodies[at(carried.body)].node];
  return free;
}

/// The graph whose edges are the elements and links between different vertices.  A node without a vertex has -1.
Graph node_graph(const network::Network& network, const Table<SceneNode, int>& vertex, int vertices) {
  Graph graph;
  graph.first.assign(at(vertices) + 1, 0);
  const auto for_each_edge = [&](auto&& visit) {
    for (const auto& element : network.elements) {
      const int a = vertex[element.node[0]];
      const int b = vertex[element.node[1]];
      if (a >= 0 && b >= 0 && a != b) visit(a, b);
    }
    for (const auto& link : network.links) visit(vertex[link.node[0]], vertex[link.node[1]]);
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

struct Cut {
  std::vector<int> part;         ///< per vertex
  std::vector<bool> interface;   ///< per vertex
  std::vector<int> order;        ///< the interface's vertices in the order of elimination
  Graph coupled;                 ///< couplings of the interface, by index into order
};

Cut make_cut(const Graph& graph, const std::vector<int>& work, MPI_Comm communicator) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &ranks);
  Cut cut;
  cut.part = rank == 0 ? cut_network(graph, ranks, work) : std::vector<int>(at(graph.vertices()));
  MPI_Bcast(cut.part.data(), graph.vertices(), MPI_INT, 0, communicator);
  cut.interface = find_interface(graph, cut.part);
  for (int v = 0; v < graph.vertices(); ++v)
    if (cut.interface[at(v)]) cut.order.push_back(v);
  const Graph coupled = interface_graph(graph, cut.interface);
  std::vector<int> order = elimination_order(coupled);
  cut.coupled = subgraph(coupled, order);
  if (order.empty()) return cut;
  for (int& i : order) i = cut.order[at(i)];
  cut.order = std::move(order);
  return cut;
}

/// The vertices of a part in solver order.  The interior comes first, in an order of elimination that keeps the
/// adjacent interface vertices.  The part's own interface vertices come last.
std::vector<int> order_part(const Graph& graph, const Cut& cut, int part) {
  std::vector<int> vertices;
  const auto is_inside = [&](int v) { return cut.part[at(v)] == part && !cut.interface[at(v)]; };
  for (int v = 0; v < graph.vertices(); ++v)
    if (is_inside(v)) vertices.push_back(v);
  std::vector<bool> kept(vertices.size(), false);
  for (const int v : cut.order) {
    const auto row = graph.adjacent.begin();
    if (std::any_of(row + graph.first[at(v)], row + graph.first[at(v) + 1], is_inside)) vertices.push_back(v);
  }
  kept.resize(vertices.size(), true);
  std::vector<int> order = elimination_order(subgraph(graph, vertices), kept);
  for (int& k : order) k = vertices[at(k)];
  for (const int v : cut.order)
    if (cut.part[at(v)] == part) order.push_back(v);
  return order;
}

/// @param order  the vertices, rank after rank   @param part  the part of every vertex
void number_nodes(const std::vector<int>& order, const std::vector<SceneNode>& free_nodes, const std::vector<int>& part,
                  int ranks, int nodes, Partition& partition) {
  partition.node_owner.resize(nodes, 0);
  partition.solver_number.resize(nodes);
  partition.first_number.assign(at(ranks) + 1, SolverNumber(0));
  SolverNumber number(0);
  for (const int v : order) {
    const SceneNode node = free_nodes[at(v)];
    partition.node_owner[node] = part[at(v)];
    partition.solver_number[node] = number;
    ++number;
    partition.first_number[at(part[at(v)]) + 1] = number;
  }
  for (std::size_t r = 1; r < partition.first_number.size(); ++r)
    partition.first_number[r] = std::max(partition.first_number[r], partition.first_number[r - 1]);
}

/// A carried node has the owner and the solver number of its body.
void number_carried(const network::Network& network, Partition& partition) {
  for (const auto& carried : network.carried) {
    const SceneNode body = network.bodies[at(carried.body)].node;
    partition.node_owner[carried.node] = partition.node_owner[body];
    partition.solver_number[carried.node] = partition.solver_number[body];
  }
}

Blocks make_blocks(const network::Network& network, const Partition& partition) {
  std::vector<std::pair<SolverNumber, int>> large;
  for (const auto& body : network.bodies)
    if (const int more = bodies::rotation_unknowns(body.properties.rotation); more > 0)
      large.emplace_back(partition.solver_number[body.node], 3 + more);
  std::sort(large.begin(), large.end());
  return {partition.first_number.back().value(), std::move(large)};
}

/// The work in a step, in multiples of a usual node's: of a body that turns, and of each node that it carries.
constexpr int body_work = 8, attachment_work = 2;

std::vector<int> work_of(const network::Network& network, const FreeNodes& free) {
  std::vector<int> work(free.node.size(), 1);
  for (const auto& body : network.bodies)
    if (bodies::rotation_unknowns(body.properties.rotation) > 0)
      work[at(free.vertex[body.node])] += body_work + attachment_work * body.carried;
  return work;
}

void assign_elements(const network::Network& network, Partition& partition) {
  // An element without free nodes goes to a rank that has rows in the solver's vectors.  A failure of the element then
  // shows in their norms.
  const auto first_rank =
      std::upper_bound(partition.first_number.begin(), partition.first_number.end(), SolverNumber(0));
  const int otherwise = static_cast<int>(first_rank - partition.first_number.begin()) - 1;
  partition.element_owner.reserve(network.elements.size());
  for (const auto& [node, material, length] : network.elements) {
    const auto free_end =
        std::find_if(node.begin(), node.end(), [&](SceneNode n) { return partition.solver_number[n].exists(); });
    partition.element_owner.push_back(free_end == node.end() ? otherwise : partition.node_owner[*free_end]);
  }
  Table<SceneNode, bool> taken(network.position.size(), false);
  for (std::size_t i = 0; i < network.elements.size(); ++i)
    for (const SceneNode node : network.elements[i].node)
      if (!partition.solver_number[node].exists() && !taken[node]) {
        taken[node] = true;
        partition.node_owner[node] = partition.element_owner[i];
      }
}

}   // namespace

Partition make_partition(const network::Network& network, MPI_Comm communicator) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &ranks);
  const FreeNodes free = find_free_nodes(network);
  Partition partition;
  const Graph graph = simple_graph(node_graph(network, free.vertex, static_cast<int>(free.node.size())));
  Cut cut = make_cut(graph, work_of(network, free), communicator);
  number_nodes(all_orders(order_part(graph, cut, rank), graph.vertices(), communicator), free.node, cut.part, ranks,
               network.position.size(), partition);
  number_carried(network, partition);
  partition.blocks = make_blocks(network, partition);
  partition.interface.graph = std::move(cut.coupled);
  for (const int v : cut.order) partition.interface.number.push_back(partition.solver_number[free.node[at(v)]]);
  assign_elements(network, partition);
  return partition;
}

}   // namespace cablenet::partition
