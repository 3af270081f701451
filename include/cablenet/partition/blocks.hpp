#pragma once
#include <utility>
#include <vector>

#include "cablenet/base/index.hpp"

/// Tests: tests/parallel/partition_test.cpp
namespace cablenet::partition {

/// The unknowns in blocks, one after the other in solver order: 3 for a node, 3 to 7 for a body.
class Blocks {
public:
  Blocks() = default;
  /// @param count  of all blocks   @param large  (block, size) of those whose size is not 3, ascending
  Blocks(int count, std::vector<std::pair<SolverNumber, int>> large);

  int count() const { return count_; }
  /// Do all have 3 unknowns?
  bool uniform() const { return large_.empty(); }
  int size(SolverNumber block) const;
  /// Its first unknown of all ranks'; of count(), the number of all unknowns.
  int begin(SolverNumber block) const;
  /// The block that an unknown of all ranks' belongs to.
  SolverNumber block_of(int unknown) const;

private:
  struct Large {
    SolverNumber block;
    int size, begin;
  };
  /// The last large block before `block`; nullptr if there is none.
  const Large* before(SolverNumber block) const;

  int count_ = 0;
  std::vector<Large> large_;
};

}   // namespace cablenet::partition
