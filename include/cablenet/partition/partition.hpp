#pragma once
#include <mpi.h>

#include <vector>

#include "cablenet/network/network.hpp"
#include "cablenet/partition/blocks.hpp"
#include "cablenet/partition/graph.hpp"

/// A partition tells which rank computes what, and in which order the unknowns are numbered.
/// Tests: tests/parallel/partition_test.cpp
namespace cablenet::partition {

/// The interface is the free nodes that separate the ranks' interiors: no element joins interior nodes of two ranks.
struct Interface {
  std::vector<SolverNumber> number;   ///< in the order of elimination
  /// The couplings of the interface once all interiors are eliminated, by index into `number`.  The graph has no
  /// vertices where these couplings are far too many to be eliminated.
  Graph graph;
};

/// Owners and solver numbers of the whole network, the same on every rank.
struct Partition {
  Table<SceneNode, int> node_owner;   ///< per node; a prescribed node belongs to a rank that has an element at it
  std::vector<int>
      element_owner;   ///< per element: the owner of its first free node, or else the first rank with free nodes
  /// Per node: its number, or its body's if the node is carried; none if it is prescribed.  The numbers of a rank are
  /// contiguous: first its interior nodes from leaf to root (elimination_order), then its interface nodes.
  Table<SceneNode, SolverNumber> solver_number;
  std::vector<SolverNumber> first_number;   ///< per rank, and one past the last
  Blocks blocks;                            ///< by solver number
  Interface interface;                      ///< empty on one rank
};

/// Rank 0 cuts the graph of free nodes, and each rank orders its own part.
/// There may be any number of ranks, more than nodes too, and any number of networks that are not joined.
/// Collective.
Partition make_partition(const network::Network& network, MPI_Comm communicator);

}   // namespace cablenet::partition
