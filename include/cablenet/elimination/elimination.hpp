#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "cablenet/elimination/plan.hpp"

/// Direct solution of a network's linear systems: L U (L D L^T where symmetric) of small dense blocks along a plan.
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
  /// Negative pivots: with a symmetric matrix, its negative eigenvalues; of a block that is not 3x3, whose rows are
  /// exchanged, 1 where their number is odd.
  int negative = 0;
};

/// Not symmetric where sizes are mixed.
class Elimination {
public:
  /// @param where  asked for each block (row, column) of the eliminated blocks' rows and columns
  Elimination(Plan plan, const std::function<BlockSource(int row, int column)>& where);

  const Plan& plan() const { return plan_; }

  /// Factors the matrix whose entries stand in `arrays`, and what it takes from the kept blocks' couplings.
  Pivots factor(const Arrays& arrays);
  /// What factor() adds to a coupling of kept blocks, row-major.
  const double* update(const Plan::Kept& kept) const { return values_.data() + kept.values; }

  /// Eliminates from a right-hand side of the eliminated blocks, in place; adds the kept system's part to `kept`.
  void forward(double* w, double* kept);
  /// Turns w into the solution, the kept blocks' being known.
  void backward(double* w, const double* kept);

private:
  /// A step at which not all blocks are 3x3; where the pivot is not, its row exchanges begin at `origins`.
  struct Large {
    int block, origins;
  };
  /// A vector over all blocks.  Its first `count` values are those of the eliminated blocks and stand apart from the
  /// kept ones', which may be none.
  template <class Value>
  struct Joined {
    Value* eliminated;
    Value* kept;
    std::ptrdiff_t count;
    Value* at(std::ptrdiff_t unknown) const {
      return unknown < count ? eliminated + unknown : kept + (unknown - count);
    }
  };

  void add_source(BlockSource source);
  void prepare_mixed();
  /// run(begin, end) for the 3x3 blocks between two large ones, step(large), run(begin, end), and so on; until one
  /// returns false.
  template <class Run, class Step>
  void visit_forward(Run&& run, Step&& step) const;
  /// The same from behind.
  template <class Run, class Step>
  void visit_backward(Run&& run, Step&& step) const;
  /// @param target  of the first update; gets the next after the last one
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
  /// Of the eliminated blocks.
  std::ptrdiff_t unknowns() const;
  /// @returns the number of negative pivots, -1 if the pivot is singular
  int factor_large(const Large& step, const Arrays& arrays, const std::int64_t*& target);
  template <class Own>
  int factor_step(const Large& step, Own own, const Arrays& arrays, const std::int64_t*& target);
  void forward_large(const Large& step, const Joined<double>& x);
  void backward_large(const Large& step, double* w, const Joined<const double>& x);
  /// visit(block (k, j), block (j, k), j) for each later neighbour j
  template <class Visit>
  void visit_later(int k, Visit&& visit);

  Plan plan_;
  std::vector<BlockSource> sources_;   ///< in the order of factoring
  std::vector<double> values_;
  std::vector<Large> large_;
  std::vector<int> begin_;       ///< mixed sizes: each block's first unknown, and one past the last
  std::vector<int> origins_;     ///< of the rows of pivots that are not 3x3
  std::vector<double> column_;   ///< symmetric: the blocks below a pivot before they are divided by it
};

}   // namespace cablenet::elimination
