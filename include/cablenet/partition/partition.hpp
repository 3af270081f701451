#pragma once
#include <mpi.h>

#include <vector>

#include "cablenet/network/network.hpp"

/// Who computes what, and in which order the unknowns are numbered.  Tests: tests/parallel/partition_test.cpp
namespace cablenet::partition {

/// Owners and solver numbers of the whole network, the same on every rank.
struct Partition {
  std::vector<int> node_owner;   ///< per node; a prescribed node belongs to a rank that has an element at it
  std::vector<int>
      element_owner;   ///< per element: the owner of a free node of its, else the first rank with free nodes
  std::vector<int> solver_number;   ///< per node: contiguous on each rank, leaf to root within it; -1 if prescribed
  std::vector<int> first_number;    ///< per rank, and one past the last
  int loops = 0;                    ///< independent loops of the free nodes' graph: 0 for trees
  std::vector<int> elimination;     ///< of trees and near-trees: solver numbers in one order for any number of ranks
};

/// METIS cuts the graph of free nodes on rank 0; each rank orders its own part.
/// Any number of ranks, also more than nodes, and any number of separate networks.
/// Collective.
Partition make_partition(const network::Network& network, MPI_Comm communicator);

/// Networks with at most this many independent loops count as near-trees.
inline constexpr int few_loops = 10;

/// A graph in compressed rows: the neighbours of vertex i are adjacent[first[i]] .. adjacent[first[i+1]-1].
struct Graph {
  std::vector<int> first;
  std::vector<int> adjacent;
};

/// Elimination order that keeps trees free of fill: leaves are peeled off along their cables; what has loops is
/// ordered last, by nested dissection.
/// @returns the vertices in the order of elimination.
std::vector<int> elimination_order(const Graph& graph);

}   // namespace cablenet::partition
