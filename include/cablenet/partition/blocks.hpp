#pragma once
#include <utility>
#include <vector>

/// Tests: tests/parallel/partition_test.cpp
namespace cablenet::partition {

/// The unknowns in blocks, one after the other in solver order: 3 for a node, 3 to 7 for a body.
class Blocks {
public:
  Blocks() = default;
  /// @param count  of all blocks   @param large  (block, size) of those whose size is not 3, ascending
  Blocks(int count, std::vector<std::pair<int, int>> large);

  int count() const { return count_; }
  /// Do all have 3 unknowns?
  bool uniform() const { return large_.empty(); }
  int size(int block) const;
  /// Its first unknown; of count(), the number of all unknowns.
  int begin(int block) const;
  /// The block that an unknown belongs to.
  int block_of(int unknown) const;

private:
  struct Large {
    int block, size, begin;
  };
  /// The last large block before `block`; nullptr if there is none.
  const Large* before(int block) const;

  int count_ = 0;
  std::vector<Large> large_;
};

}   // namespace cablenet::partition
