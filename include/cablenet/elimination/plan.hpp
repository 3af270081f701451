#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "cablenet/base/index.hpp"

/// The order of work of a block elimination, laid down once for a pattern of couplings.
/// Tests: tests/unit/elimination_test.cpp
namespace cablenet::elimination {

inline constexpr int largest_block = 7;

/// Which blocks of unknowns are coupled.  Blocks 0 .. eliminated-1 are eliminated in this order, the others are kept.
struct BlockGraph {
  std::vector<int> size;   ///< unknowns of each block, 1 .. largest_block
  int eliminated = 0;
  /// Neighbours of eliminated block k: adjacent[first[k]] .. adjacent[first[k+1]-1], kept ones and itself may be among
  /// them.
  std::vector<int> first;
  std::vector<int> adjacent;
};

/// Values lie in four regions, so that each sweep of a solution reads one or two of them from end to end: the pivots
/// (k, k), then for each coupling of a block k with a later neighbour j the blocks (k, j), unless symmetric, and (j,
/// k), then the couplings (i, j) of kept blocks that the elimination changes, where symmetric those with i >= j.  All
/// blocks are row-major.
struct Plan {
  /// A coupling of two kept blocks that the elimination changes.
  struct Kept {
    int row, column;
    std::int64_t values;
  };

  bool symmetric = false;
  bool uniform = false;           ///< all blocks are 3x3
  std::vector<int> size;          ///< as in the pattern
  std::vector<int> first_later;   ///< per eliminated block k, and one past the last: its couplings
  std::vector<int> later;         ///< later neighbours, ascending, per coupling
  /// Per block in the order of factoring, that is of each k its pivot and then of each coupling (k, j), unless
  /// symmetric, and (j, k): updates come before its own entries.
  std::vector<bool> touched;
  std::vector<Kept> kept;
  /// Per block k and pair (i, j) of its later neighbours, row after row (symmetric: j not after i): where the update of
  /// (i, j) goes; ~offset where it is the first there.
  std::vector<std::int64_t> targets;
  /// If not uniform: where they begin in their regions, and the ends.
  std::vector<std::int64_t> mixed_pivots, mixed_couplings;
  std::int64_t upper_values = 0, lower_values = 0, kept_values = 0;   ///< where the regions begin
  std::int64_t values = 0;                                            ///< in all
  double updates = 0;   ///< products of 3x3 blocks in a factorisation, or as much work

  int eliminated() const { return static_cast<int>(first_later.size()) - 1; }
  std::int64_t pivot(int k) const { return uniform ? 9 * std::int64_t{k} : mixed_pivots[at(k)]; }
  /// Of (k, j) in its region, as of (j, k) in its own.
  std::int64_t coupling(int i) const { return uniform ? 9 * std::int64_t{i} : mixed_couplings[at(i)]; }
};

/// @param symmetric  taken up where all blocks are 3x3
/// @returns nothing if a factorisation takes more than `most_updates` block products.
std::optional<Plan> make_plan(const BlockGraph& graph, bool symmetric,
                              double most_updates = std::numeric_limits<double>::infinity());

}   // namespace cablenet::elimination
