#pragma once
#include <mpi.h>

#include <vector>

#include "cablenet/network/network.hpp"
#include "cablenet/partition/blocks.hpp"
#include "cablenet/partition/graph.hpp"

/// Who computes what, and in which order the unknowns are numbered.  Tests: tests/parallel/partition_test.cpp
namespace cablenet::partition {

/// The free nodes that keep the ranks' interiors apart: no element joins interior nodes of two ranks.
struct Interface {
  std::vector<SolverNumber> number;   ///< in the order of elimination
  /// By index into number: what is coupled once all interiors are eliminated; without vertices where that is far too
  /// much to eliminate.
  Graph graph;
};

/// Owners and solver numbers of the whole network, the same on every rank.
struct Partition {
  Table<SceneNode, int> node_owner;   ///< per node; a prescribed node belongs to a rank that has an element at it
  std::vector<int>
      element_owner;   ///< per element: the owner of a free node of its, else the first rank with free nodes
  /// Per node, none if prescribed, its body's if carried: contiguous on each rank, its interior from leaf to root, then
  /// its interface nodes.
  Table<SceneNode, SolverNumber> solver_number;
  std::vector<SolverNumber> first_number;   ///< per rank, and one past the last
  Blocks blocks;                            ///< by solver number
  Interface interface;                      ///< empty on one rank
};

/// Rank 0 cuts the graph of free nodes; each rank orders its own part.
/// Any number of ranks, also more than nodes, and any number of separate networks.
/// Collective.
Partition make_partition(const network::Network& network, MPI_Comm communicator);

}   // namespace cablenet::partition
