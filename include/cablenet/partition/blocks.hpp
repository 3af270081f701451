#pragma once
#include <utility>
#include <vector>

#include "cablenet/base/index.hpp"

/// Tests: tests/parallel/partition_test.cpp
namespace cablenet::partition {

/// The unknowns stand in blocks, in solver order.  A node's block has 3 unknowns, a body's has 3, 6 or 7.
class Blocks {
public:
  Blocks() = default;
  /// @param count  number of all blocks
  /// @param large  (block, size) of the blocks whose size is not 3, ascending
  Blocks(int count, std::vector<std::pair<SolverNumber, int>> large);

  int count() const { return count_; }
  /// Do all blocks have 3 unknowns?
  bool uniform() const { return large_.empty(); }
  int size(SolverNumber block) const;
  /// The first unknown of a block, counted over all ranks.  begin(count()) is the number of all unknowns.
  int begin(SolverNumber block) const;
  /// The block to which an unknown belongs.  @param unknown  counted over all ranks
  SolverNumber block_of(int unknown) const;

private:
  struct Large {
    SolverNumber block;
    int size, begin;
  };
  /// The last large block before `block`, or nullptr if there is none.
  const Large* before(SolverNumber block) const;

  int count_ = 0;
  std::vector<Large> large_;
};

}   // namespace cablenet::partition
