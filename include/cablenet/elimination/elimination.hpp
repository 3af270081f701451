#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "cablenet/elimination/schedule.hpp"

/// Direct solution of a network's linear systems: L U (L D L^T where symmetric) of small dense blocks along a schedule.
/// Pivot blocks are factored, never inverted: their condition is that of axial over transverse stiffness, up to 1e10,
/// and an inverse would lose as many digits.  3x3 pivots are taken as they come, larger ones with row exchanges.
/// Tests: tests/unit/elimination_test.cpp
namespace cablenet::elimination {

/// Where a block's entries stand: row r begins at arrays[array] + offset + r * stride.
struct BlockSource {
  int offset = 0;
  unsigned stride : 27 = 0;
  unsigned array : 2 = 0;
  unsigned absent : 1 = 1;   ///< fill: the matrix has no such block
  unsigned transposed : 1 = 0;
  unsigned touched : 1 = 0;   ///< for Elimination's own use
};

inline BlockSource block_source(int offset, int stride, unsigned array) {
  return {offset, static_cast<unsigned>(stride) & 0x7ffffff, array & 3, 0, 0, 0};
}

/// The arrays that sources refer to.
using Arrays = std::array<const double*, 3>;

/// What became of the pivots.
struct Pivots {
  int singular = -1;   ///< the first block whose pivot is singular to rounding; the elimination ended there
  int negative = 0;    ///< negative pivots: with a symmetric matrix, its negative eigenvalues
};

/// Not symmetric where sizes are mixed.
class Elimination {
public:
  /// @param where  asked for each block (row, column) of the eliminated blocks' rows and columns
  Elimination(Schedule schedule, const std::function<BlockSource(int row, int column)>& where);

  const Schedule& schedule() const { return schedule_; }

  /// Factors the matrix whose entries stand in `arrays`, and what it takes from the kept blocks' couplings.
  Pivots factor(const Arrays& arrays);
  /// What factor() adds to a coupling of kept blocks, row-major.
  const double* update(const Schedule::Kept& kept) const { return values_.data() + kept.values; }

  /// Eliminates from a right-hand side of the eliminated blocks, in place; adds the kept system's part to `kept`.
  void forward(double* w, double* kept);
  /// Turns w into the solution, the kept blocks' being known.
  void backward(double* w, const double* kept);

private:
  template <bool symmetric>
  Pivots factor_uniform(const Arrays& arrays);
  void prepare_mixed();
  Pivots factor_mixed(const Arrays& arrays);
  void forward_uniform(double* w, double* kept);
  template <bool symmetric>
  void backward_uniform(double* w, const double* kept);
  void add_source(BlockSource source);
  /// visit(block (k, j), block (j, k), j) for each later neighbour j
  template <class Visit>
  void visit_later(int k, Visit&& visit);
  void forward_mixed(double* w, double* kept);
  void backward_mixed(double* w, const double* kept);

  Schedule schedule_;
  std::vector<BlockSource> sources_;   ///< in the order of factoring
  std::vector<double> values_;
  std::vector<int> begin_;       ///< mixed sizes: each block's first unknown, kept ones' from the first of them
  std::vector<int> exchanges_;   ///< mixed sizes: row exchanges of the pivots, largest_block per eliminated block
  std::vector<double> column_;   ///< symmetric: the blocks below a pivot before they are divided by it
};

}   // namespace cablenet::elimination
