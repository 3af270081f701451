#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "cablenet/base/index.hpp"

/// A plan lays down the work of a block elimination, once for a pattern of couplings.
/// Tests: tests/unit/elimination_test.cpp
namespace cablenet::elimination {

/// The most unknowns of a block: the position and the quaternion of a body.
inline constexpr int largest_block = 7;

/// Which blocks of unknowns are coupled.  Blocks 0 .. eliminated-1 are eliminated in this order; the others are kept.
struct BlockGraph {
  std::vector<int> size;   ///< unknowns of each block, 1 .. largest_block
  int eliminated = 0;
  /// The neighbours of eliminated block k are adjacent[first[k]] .. adjacent[first[k+1]-1].  Kept blocks and k itself
  /// may be among them.
  std::vector<int> first;
  std::vector<int> adjacent;
};

/// The plan of an elimination.  Block j is a later neighbour of block k if it comes later and the elimination couples
/// them.  The values lie in four regions, so that each sweep of a solution reads one or two of them from end to end:
///   pivots  (k, k)
///   upper   (k, j) for each coupling of a block k with a later neighbour j; empty where symmetric
///   lower   (j, k) for each such coupling
///   kept    (i, j) for each coupling of kept blocks that the elimination changes; where symmetric, those with i >= j
/// All blocks are row-major.
struct Plan {
  /// A coupling of two kept blocks that the elimination changes.
  struct Kept {
    int row, column;
    std::int64_t values;   ///< offset
  };

  bool symmetric = false;
  bool uniform = false;           ///< all blocks are 3x3
  std::vector<int> size;          ///< as in BlockGraph
  std::vector<int> first_later;   ///< block k has the couplings first_later[k] .. first_later[k+1]-1
  std::vector<int> later;         ///< per coupling: the later neighbour; they ascend within a block
  /// Per block in the order of factoring: do updates reach it before its own entries are loaded?  The order is by k:
  /// first the pivot of k, then for each coupling the blocks (k, j), unless symmetric, and (j, k).
  std::vector<bool> touched;
  std::vector<Kept> kept;
  /// The offset of the block (i, j) that each update changes.  Block k has an update for each pair (i, j) of its later
  /// neighbours, row after row; where symmetric, only for pairs in which j is not after i.  The first update of a block
  /// in the first three regions has ~offset instead: it sets the values and adds nothing to them.
  std::vector<std::int64_t> targets;
  /// Where sizes are mixed: the offsets of pivots and couplings in their regions, and the regions' ends.
  std::vector<std::int64_t> mixed_pivots, mixed_couplings;
  std::int64_t upper_values = 0, lower_values = 0, kept_values = 0;   ///< where the regions begin
  std::int64_t values = 0;                                            ///< number of all values
  double updates = 0;   ///< work of a factorisation, in products of two 3x3 blocks

  int eliminated() const { return static_cast<int>(first_later.size()) - 1; }
  std::int64_t pivot(int k) const { return uniform ? 9 * std::int64_t{k} : mixed_pivots[at(k)]; }
  /// The offset of coupling i, which is the same for (k, j) in the upper region and for (j, k) in the lower one.
  std::int64_t coupling(int i) const { return uniform ? 9 * std::int64_t{i} : mixed_couplings[at(i)]; }
};

/// @param symmetric  whether the matrix is symmetric, which the plan uses only where all blocks are 3x3
/// @returns nothing if a factorisation takes more than `most_updates` products of two 3x3 blocks
/// @throws std::invalid_argument if a block has no unknowns or more than largest_block
std::optional<Plan> make_plan(const BlockGraph& graph, bool symmetric,
                              double most_updates = std::numeric_limits<double>::infinity());

}   // namespace cablenet::elimination
