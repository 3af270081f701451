#pragma once
#include <array>

namespace cablenet::system {

/// Where a block of the tangent stands: rows of `stride` values from arrays[other] + offset.
struct Slot {
  int offset = 0;
  unsigned stride : 29 = 0;
  unsigned add : 1 = 0;      ///< Something before it in an evaluation has written the block.
  unsigned other : 1 = 0;    ///< The block's columns belong to another rank.
  unsigned absent : 1 = 1;   ///< The block's row or column is no unknown of this rank's rows.
};

/// The blocks (1, 1), (1, 2), (2, 1), (2, 2) of two nodes.  A carried node stands for its body.  The body's own
/// block is absent, as the body collects it.
using PairSlots = std::array<Slot, 4>;

}   // namespace cablenet::system
