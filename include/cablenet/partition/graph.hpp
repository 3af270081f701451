#pragma once
#include <vector>

/// Graphs, and the order in which their vertices are eliminated from a sparse system.
/// Tests: tests/parallel/graph_test.cpp
namespace cablenet::partition {

/// A graph in compressed rows: the neighbours of vertex i are adjacent[first[i]] .. adjacent[first[i+1]-1].
struct Graph {
  std::vector<int> first;
  std::vector<int> adjacent;

  int vertices() const { return first.empty() ? 0 : static_cast<int>(first.size()) - 1; }
};

/// The same graph with every pair joined once, no vertex joined to itself, and neighbours in ascending order.
Graph simple_graph(const Graph& graph);

/// The graph among `vertices`, numbered as listed there.
Graph subgraph(const Graph& graph, const std::vector<int>& vertices);

/// Per vertex: the number of its connected piece once the barred vertices are away; -1 for those.
/// @param barred  none if empty
std::vector<int> connected_pieces(const Graph& graph, const std::vector<bool>& barred = {});

/// Independent loops: edges - vertices + connected pieces.
int count_loops(const Graph& graph);

/// Elimination order that keeps trees free of fill and leaves at most two later neighbours to every vertex that is
/// eliminated before all have three: leaves are peeled off along their cables, then paths from end to end; what has
/// loops enough to be left is ordered last, by nested dissection.
/// @param kept  vertices that are never eliminated though they are neighbours; none if empty
/// @returns the vertices that are not kept, in the order of elimination.
std::vector<int> elimination_order(const Graph& graph, const std::vector<bool>& kept = {});

/// Per vertex: does it stay when leaves that are not kept are peeled off?  So it lies between kept vertices or loops.
std::vector<bool> unpeeled(const Graph& graph, const std::vector<bool>& kept);

}   // namespace cablenet::partition
