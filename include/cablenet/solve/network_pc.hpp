#pragma once
#include <petscpc.h>

#include <memory>

#include "cablenet/partition/local_network.hpp"

/// Solves a network's linear systems exactly, by block elimination.  Each rank eliminates its interior nodes from leaf
/// to root.  What is left are equations for the nodes on the interface between ranks; one Allreduce sums them, and
/// every rank solves all of them.  Each rank then goes back to its interior nodes.  For trees and networks with few
/// loops the cost is O(nodes).
/// Tests: tests/parallel/network_pc_test.cpp, mixed_blocks_test.cpp
namespace cablenet::solve {

/// What the last factorisation met, on all ranks together.
struct PivotReport {
  SolverNumber singular_node;   ///< a node at which the tangent is singular; none where it is not
  long negative = 0;            ///< negative pivots
};

/// All member functions are collective.
class NetworkPc {
public:
  /// @param matrix         AIJ, in the blocks of `network` and in its numbering.  Its values are read at each
  ///                       factorisation
  /// @param most_per_node  the limit on the work of a factorisation: products of 3x3 blocks on a rank, divided by the
  ///                       mean number of nodes on a rank.  A body counts as several nodes, by its unknowns.  A product
  ///                       of larger blocks counts as several products, by its work
  /// @returns nothing where a factorisation would take more
  static std::unique_ptr<NetworkPc> make(const partition::LocalNetwork& network, Mat matrix, double most_per_node);
  ~NetworkPc();

  /// Makes `pc` a PCSHELL that solves with this.  The PC must not be used after this is gone.
  void attach(PC pc);
  /// Block products of a factorisation for each node, on the rank that has most of them, the interface's included.
  double updates_per_node() const;
  PivotReport pivots() const;

private:
  class Impl;
  explicit NetworkPc(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}   // namespace cablenet::solve
