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

  static elimination::Pattern pattern(const partition::Interface& interface);

  /// Starts a sum.  @param new_matrix  the matrix is summed too; else it is the last one
  void clear(bool new_matrix);
  /// Where block (row, column) stands, for add().
  std::size_t block(int row, int column) const;
  /// block += values, by rows of `stride`, or their transpose.  @pre clear(true)
  void add(std::size_t block, const double* values, std::size_t stride, bool transposed);
  double* right_side(int node) { return sum_.data() + 3 * static_cast<std::size_t>(node); }
  void add_failure() { sum_[failures_] += 1; }
  /// Collective.  @returns false if a rank has failed or the matrix is singular
  bool solve();
  const double* solution(int node) const { return sum_.data() + 3 * static_cast<std::size_t>(node); }
  const elimination::Pivots& pivots() const { return pivots_; }

private:
  MPI_Comm communicator_;
  partition::Graph rows_;     ///< each row's columns, itself included, ascending
  std::vector<double> sum_;   ///< right side, failures, matrix blocks
  std::size_t failures_;
  bool new_matrix_ = false;
  std::unique_ptr<elimination::Elimination> elimination_;
  elimination::Pivots pivots_;
};

}   // namespace cablenet::solve
