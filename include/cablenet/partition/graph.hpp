#pragma once
#include <vector>

/// A sparse linear system is solved by eliminating the vertices of its graph.  An elimination joins all neighbours of
/// its vertex with each other; the edges that are new are called fill.  This header has graphs, and an order of
/// elimination with little fill.
/// Tests: tests/parallel/graph_test.cpp
namespace cablenet::partition {

/// A graph in compressed rows: the neighbours of vertex i are adjacent[first[i]] .. adjacent[first[i+1]-1].
struct Graph {
  std::vector<int> first;
  std::vector<int> adjacent;

  int vertices() const { return first.empty() ? 0 : static_cast<int>(first.size()) - 1; }
};

/// The same graph without repeated edges and without edges from a vertex to itself.  Neighbours are in ascending order.
Graph simple_graph(const Graph& graph);

/// The graph of `vertices` and the edges among them.  Its vertex i is vertices[i].
Graph subgraph(const Graph& graph, const std::vector<int>& vertices);

/// Per vertex: the number of its connected piece in the graph without the barred vertices; -1 for a barred vertex.
/// @param barred  per vertex; no vertex is barred if empty
std::vector<int> connected_pieces(const Graph& graph, const std::vector<bool>& barred = {});

/// The number of independent loops: edges - vertices + connected pieces.
int count_loops(const Graph& graph);

/// An order of elimination with little fill.  It has three stages.
/// 1. Leaves, which have one neighbour or none, are peeled off from the end of a cable inwards.  This makes no fill.
///    A tree is eliminated completely.
/// 2. Paths of vertices with two neighbours are eliminated from end to end, and leaves that appear are peeled off.
/// 3. The rest, in which every vertex that is not kept has three neighbours or more, is ordered by nested dissection.
/// A vertex of the first two stages thus has at most two neighbours left when it is eliminated.
/// @param kept  per vertex: it is never eliminated, but counts as a neighbour; no vertex is kept if empty
/// @returns the vertices that are not kept, in the order of elimination
std::vector<int> elimination_order(const Graph& graph, const std::vector<bool>& kept = {});

/// Per vertex: does it stay when all leaves but kept ones are peeled off?  A vertex that stays is kept, lies on a loop,
/// or lies between kept vertices or loops.
std::vector<bool> unpeeled(const Graph& graph, const std::vector<bool>& kept);

}   // namespace cablenet::partition
