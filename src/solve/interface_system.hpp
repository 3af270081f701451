#pragma once
#include <mpi.h>

#include <memory>
#include <vector>

#include "cablenet/elimination/elimination.hpp"
#include "cablenet/partition/partition.hpp"

namespace cablenet::solve {

/// What is left on the interface once every rank has eliminated its interior: summed over the ranks, then solved by
/// each of them by the same elimination.
class InterfaceSystem {
public:
  /// @pre the schedule is that of pattern(interface)
  InterfaceSystem(const partition::Interface& interface, elimination::Schedule schedule, MPI_Comm communicator);

  /// @param blocks  by solver number
  static elimination::Pattern pattern(const partition::Interface& interface, const partition::Blocks& blocks);

  /// Where a block of the matrix stands.
  struct Place {
    std::size_t begin;
    int rows, columns;
  };

  /// Starts a sum.  @param new_matrix  the matrix is summed too; else it is the last one
  void clear(bool new_matrix);
  /// Of block (row, column), for add().
  Place place(int row, int column) const;
  /// block += values, by rows of `stride`, or their transpose.  @pre clear(true)
  void add(const Place& block, const double* values, std::size_t stride, bool transposed);
  /// Unknowns of a node or body.
  int size(int node) const { return static_cast<int>(begin(node + 1) - begin(node)); }
  double* right_side(int node) { return sum_.data() + begin(node); }
  void add_failure() { sum_[failures_] += 1; }
  /// Collective.  @returns false if a rank has failed or the matrix is singular
  bool solve();
  const double* solution(int node) const { return sum_.data() + begin(node); }
  const elimination::Pivots& pivots() const { return pivots_; }

private:
  std::size_t begin(int node) const { return begin_[static_cast<std::size_t>(node)]; }

  MPI_Comm communicator_;
  partition::Graph rows_;             ///< each row's columns, itself included, ascending
  std::vector<std::size_t> begin_;    ///< per node its first unknown, and one past the last
  std::vector<std::size_t> places_;   ///< per entry of rows_ its block
  std::vector<double> sum_;           ///< right side, failures, matrix blocks
  std::size_t failures_;
  bool new_matrix_ = false;
  std::unique_ptr<elimination::Elimination> elimination_;
  elimination::Pivots pivots_;
};

}   // namespace cablenet::solve
