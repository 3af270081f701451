#pragma once
#include <petscpc.h>

#include <memory>

#include "cablenet/partition/local_network.hpp"

/// Exact solution of a network's linear systems by block elimination and substructuring: each rank eliminates its
/// interior nodes from leaf to root, one Allreduce sums what is left on the interface between ranks, every rank solves
/// that and goes back.  Costs O(nodes) for trees and networks with few loops.  Reads the assembled AIJ matrix.
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
  /// @param matrix  AIJ in the blocks of `network`, numbered as there
  /// @param most_per_node  block products that a factorisation may take, over a rank's share of the nodes; larger
  /// blocks count as so many nodes and products of 3x3 as there are unknowns and work
  /// @returns nothing where that is not enough
  static std::unique_ptr<NetworkPc> make(const partition::LocalNetwork& network, Mat matrix, double most_per_node);
  ~NetworkPc();

  /// Makes `pc` a PCSHELL that solves with this; must not outlive it.
  void attach(PC pc);
  /// Block products of a factorisation, the interface's included, on the rank that has most, over its share of the
  /// nodes.
  double updates_per_node() const;
  PivotReport pivots() const;

private:
  class Impl;
  explicit NetworkPc(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}   // namespace cablenet::solve
