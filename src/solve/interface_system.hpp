#pragma once
#include <mpi.h>

#include <memory>
#include <vector>

#include "cablenet/elimination/elimination.hpp"
#include "cablenet/partition/partition.hpp"

namespace cablenet::solve {

/// A node of the interface, in partition::Interface's order.
using InterfaceNode = Index<struct InterfaceNodeSpace>;

/// What is left on the interface once every rank has eliminated its interior: summed over the ranks, then solved by
/// each of them by the same elimination.
class InterfaceSystem {
public:
  /// @pre the plan is that of block_graph(interface)
  InterfaceSystem(const partition::Interface& interface, elimination::Plan plan, MPI_Comm communicator);

  /// @param blocks  by solver number
  static elimination::BlockGraph block_graph(const partition::Interface& interface, const partition::Blocks& blocks);

  /// Where a block of the matrix stands in the sum.
  struct SummedBlock {
    std::size_t begin;
    int rows, columns;
  };

  /// Starts a sum.  @param new_matrix  the matrix is summed, too; otherwise that of the last sum stays
  void clear(bool new_matrix);
  /// Where block (row, column) stands, for add().
  SummedBlock block(InterfaceNode row, InterfaceNode column) const;
  /// block += values, by rows of `stride`, or their transpose.  @pre clear(true)
  void add(const SummedBlock& block, const double* values, std::size_t stride, bool transposed);
  /// Unknowns of a node or body.
  int size(InterfaceNode node) const { return static_cast<int>(begin_[node + 1] - begin_[node]); }
  double* right_side(InterfaceNode node) { return sum_.data() + begin_[node]; }
  void add_failure() { sum_[failures_] += 1; }
  /// Collective.  @returns false if a rank has failed or the matrix is singular
  bool solve();
  const double* solution(InterfaceNode node) const { return sum_.data() + begin_[node]; }
  /// Those of bodies included.
  elimination::Pivots pivots() const {
    return {pivots_.singular, pivots_.negative + elimination_->negative_in_bodies()};
  }

private:
  MPI_Comm communicator_;
  partition::Graph rows_;                     ///< each row's columns, itself included, ascending
  Table<InterfaceNode, std::size_t> begin_;   ///< its first unknown, and one past the last
  std::vector<std::size_t> block_begins_;     ///< per entry of rows_ its block
  std::vector<double> sum_;                   ///< right side, failures, matrix blocks
  std::size_t failures_;
  bool new_matrix_ = false;
  std::unique_ptr<elimination::Elimination> elimination_;
  elimination::Pivots pivots_;
};

}   // namespace cablenet::solve
