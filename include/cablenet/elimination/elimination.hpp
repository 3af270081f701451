#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "cablenet/elimination/plan.hpp"

/// This room solves a network's linear systems directly.  It factors small dense blocks along a plan: L U, or L D L^T
/// where the matrix is symmetric.
/// Pivot blocks are factored, never inverted.  Their condition number is the ratio of axial to transverse stiffness, up
/// to 1e10, and an inverse would lose as many digits.  3x3 pivots are factored without row exchanges, others with them.
/// Tests: tests/unit/elimination_test.cpp
namespace cablenet::elimination {

/// Where the entries of a block are found: row r begins at arrays[array] + offset + r * stride.
struct BlockSource {
  int offset = 0;
  unsigned stride : 27 = 0;
  unsigned array : 2 = 0;
  unsigned absent : 1 = 1;   ///< the matrix has no such block; the block is fill
  unsigned transposed : 1 = 0;
  unsigned touched : 1 = 0;   ///< for Elimination's own use
};

inline BlockSource block_source(int offset, int stride, unsigned array) {
  return {offset, static_cast<unsigned>(stride) & 0x7ffffff, array & 3, 0, 0, 0};
}

/// The arrays that BlockSource::array numbers.
using Arrays = std::array<const double*, 3>;

/// The verdict of a factorisation on its pivots.
struct Pivots {
  int singular = -1;   ///< the first block whose pivot is singular to rounding, where the factorisation ended; -1: none
  int negative = 0;    ///< pivots in the blocks of 3x3
};

/// A block elimination.  It makes use of symmetry only where all blocks are 3x3.
class Elimination {
public:
  /// @param where  returns the source of each block (row, column) in the rows and columns of the eliminated blocks
  Elimination(Plan plan, const std::function<BlockSource(int row, int column)>& where);

  const Plan& plan() const { return plan_; }

  /// Factors the matrix whose entries are in `arrays`, and computes what that changes in the kept blocks' couplings.
  Pivots factor(const Arrays& arrays);
  /// Negative eigenvalues of other pivot blocks.  With Pivots::negative they are as many as a symmetric matrix has.
  int negative_in_bodies() const;
  /// The block that has to be added to a coupling of kept blocks after factor(), row-major.
  const double* update(const Plan::Kept& kept) const { return values_.data() + kept.values; }

  /// Takes the forward sweep.
  /// @param w     right-hand side of the eliminated blocks, changed in place
  /// @param kept  right-hand side of the kept blocks, to which the sweep adds the eliminated blocks' part
  void forward(double* w, double* kept);
  /// Takes the backward sweep, which turns w into the solution.
  /// @param kept  the solution in the kept blocks
  void backward(double* w, const double* kept);

private:
  /// A step of the elimination at which not all blocks are 3x3.  The row exchanges of its pivot begin at
  /// origins_[origins], and a copy of it at bodies_[copy], unless the pivot is 3x3.
  struct Large {
    int block, origins, copy;
  };
  /// A vector over all blocks.  The `count` values of the eliminated blocks stand apart from the kept ones'.
  template <class Value>
  struct Joined {
    Value* eliminated;
    Value* kept;
    std::ptrdiff_t count;
    Value* at(std::ptrdiff_t i) const { return i < count ? eliminated + i : kept + (i - count); }
  };

  void add_source(BlockSource source);
  void prepare_mixed();
  /// Calls run(begin, end) for the blocks before the first large one, step(large), run(begin, end) for the blocks up to
  /// the next large one, and so on.  It stops when one of them returns false.
  template <class Run, class Step>
  void visit_forward(Run&& run, Step&& step) const;
  /// Makes the calls of visit_forward in reverse order.
  template <class Run, class Step>
  void visit_backward(Run&& run, Step&& step) const;
  /// @param target  the entry of Plan::targets for the first update; moves behind the entry for the last one
  /// @returns the first block whose pivot is singular, or `end`
  template <bool symmetric>
  int factor_run(int begin, int end, const Arrays& arrays, const std::int64_t*& target, int& negative);
  template <bool mixed>
  void forward_run(int begin, int end, const Joined<double>& x);
  template <bool symmetric, bool mixed>
  void backward_run(int begin, int end, double* w, const Joined<const double>& x);
  template <bool mixed>
  std::ptrdiff_t unknown(int block) const {
    return mixed ? begin_[at(block)] : 3 * std::ptrdiff_t{block};
  }
  /// The number of unknowns of the eliminated blocks.
  std::ptrdiff_t unknowns() const;
  /// @returns the number of negative pivots, -1 if the pivot is singular
  int factor_large(const Large& step, const Arrays& arrays, const std::int64_t*& target);
  template <class Own>
  int factor_step(const Large& step, Own own, const Arrays& arrays, const std::int64_t*& target);
  void forward_large(const Large& step, const Joined<double>& x);
  void backward_large(const Large& step, double* w, const Joined<const double>& x);
  /// Calls visit(block (k, j), block (j, k), j) for each later neighbour j of block k.
  template <class Visit>
  void visit_later(int k, Visit&& visit);

  Plan plan_;
  std::vector<BlockSource> sources_;   ///< in the order of factoring
  std::vector<double> values_;
  std::vector<Large> large_;
  std::vector<int> begin_;       ///< where sizes are mixed: each block's first unknown, and one past the last
  std::vector<int> origins_;     ///< row exchanges of the pivots that are not 3x3
  std::vector<double> bodies_;   ///< the pivots that are not 3x3, before they were factored
  std::vector<double> column_;   ///< where symmetric: the blocks below a pivot before the division by it
};

}   // namespace cablenet::elimination
