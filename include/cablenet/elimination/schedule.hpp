#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

/// The order of work of a block elimination, laid down once for a pattern of couplings.
/// Tests: tests/unit/elimination_test.cpp
namespace cablenet::elimination {

inline constexpr int largest_block = 7;

/// Which blocks of unknowns are coupled.  Blocks 0 .. eliminated-1 are eliminated in this order, the others are kept.
struct Pattern {
  std::vector<int> size;   ///< unknowns of each block, 1 .. largest_block
  int eliminated = 0;
  /// Neighbours of eliminated block k: adjacent[first[k]] .. adjacent[first[k+1]-1], kept ones and itself may be among
  /// them.
  std::vector<int> first;
  std::vector<int> adjacent;
};

/// Values are kept block after block: of each eliminated block k its pivot (k, k), then for each later neighbour j the
/// blocks (k, j) and (j, k), where symmetric (j, k) alone; behind them all couplings (i, j) of kept blocks that the
/// elimination changes, where symmetric those with i >= j.  All are row-major.
struct Schedule {
  struct Node {
    std::int64_t values;   ///< where its pivot stands
    std::int64_t first_target;
    std::int64_t first_block;
    int first_later;
  };
  /// A coupling of two kept blocks that the elimination changes.
  struct Kept {
    int row, column;
    std::int64_t values;
  };

  bool symmetric = false;
  bool uniform = false;        ///< all blocks are 3x3
  std::vector<int> size;       ///< as in the pattern
  std::vector<Node> nodes;     ///< per eliminated block, and one past the last
  std::vector<int> later;      ///< later neighbours, ascending
  std::vector<bool> touched;   ///< per block of the eliminated ones' values: updates come before its own entries
  std::vector<Kept> kept;
  /// Per block k and pair (i, j) of its later neighbours, row after row (symmetric: j not after i): where the update of
  /// (i, j) goes; ~place where it is the first there.
  std::vector<std::int64_t> targets;
  std::int64_t kept_values = 0;   ///< where the kept blocks' values begin
  std::int64_t values = 0;        ///< in all
  double updates = 0;             ///< block products in a factorisation

  int eliminated() const { return static_cast<int>(nodes.size()) - 1; }
};

/// @param symmetric  taken up where all blocks are 3x3
/// @returns nothing if a factorisation takes more than `most_updates` block products.
std::optional<Schedule> make_schedule(const Pattern& pattern, bool symmetric,
                                      double most_updates = std::numeric_limits<double>::infinity());

}   // namespace cablenet::elimination
