#include "cablenet/partition/blocks.hpp"

#include <algorithm>

namespace cablenet::partition {

Blocks::Blocks(int count, std::vector<std::pair<SolverNumber, int>> large) : count_(count) {
  int begin = 0;
  SolverNumber next(0);
  for (const auto& [block, size] : large) {
    begin += 3 * (block - next);
    large_.push_back({block, size, begin});
    begin += size;
    next = block + 1;
  }
}

const Blocks::Large* Blocks::before(SolverNumber block) const {
  const auto found = std::lower_bound(large_.begin(), large_.end(), block,
                                      [](const Large& item, SolverNumber wanted) { return item.block < wanted; });
  return found == large_.begin() ? nullptr : &*(found - 1);
}

int Blocks::size(SolverNumber block) const {
  const Large* item = before(block + 1);
  return item != nullptr && item->block == block ? item->size : 3;
}

int Blocks::begin(SolverNumber block) const {
  const Large* item = before(block);
  return item == nullptr ? 3 * block.value() : item->begin + item->size + 3 * (block - item->block - 1);
}

SolverNumber Blocks::block_of(int unknown) const {
  const auto found = std::upper_bound(large_.begin(), large_.end(), unknown,
                                      [](int wanted, const Large& item) { return wanted < item.begin; });
  if (found == large_.begin()) return SolverNumber(unknown / 3);
  const Large& item = *(found - 1);
  if (unknown < item.begin + item.size) return item.block;
  return item.block + (1 + (unknown - item.begin - item.size) / 3);
}

}   // namespace cablenet::partition
