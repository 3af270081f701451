#pragma once
#include <mpi.h>
#include <petscmat.h>

#include <array>
#include <vector>

#include "cablenet/partition/local_network.hpp"
#include "cablenet/system/slot.hpp"

namespace cablenet::system {

/// Which blocks of the tangent this rank's rows have, and where each stands in the matrix's arrays.
/// Terms ask for their blocks twice, in the order in which they write them: at first the pattern notes the blocks,
/// after fix() it answers with their slots.  The first to ask for a block writes it, all others add to it, so that
/// nothing has to be cleared.  A body's own block is the exception: the body clears it, and all add.
class BlockPattern {
public:
  explicit BlockPattern(const partition::LocalNetwork& network) : network_(network) {}

  /// The block of two nodes.  A carried node stands for its body.
  Slot block(LocalNode row, LocalNode column);
  /// The node's block with itself; none for a carried node, whose body collects it.
  Slot own(LocalNode node) { return network_.is_carried(node) ? Slot{} : block(node, node); }
  /// The blocks of two nodes without those of carried nodes with themselves, which their body collects.
  PairSlots pair(const std::array<LocalNode, 2>& node);
  /// Those of each item: an item has one node, or two.
  template <class Item>
  std::vector<Slot> own(const std::vector<Item>& items) {
    std::vector<Slot> slots(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) slots[i] = own(items[i].node);
    return slots;
  }
  template <class Item>
  std::vector<PairSlots> pairs(const std::vector<Item>& items) {
    std::vector<PairSlots> slots(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) slots[i] = pair(items[i].node);
    return slots;
  }

  /// All blocks are noted.
  /// Collective.  @throws InputError on every rank alike where a rank has more values than 32 bits can count.
  void fix(MPI_Comm communicator);
  /// The pair slots of the network's elements, which several terms write to.
  const std::vector<PairSlots>& elements() const { return elements_; }
  void add_elements() { elements_ = pairs(network_.elements); }
  void preallocate(Mat matrix) const;

private:
  /// Block columns of each owned node's row, ascending, in compressed rows; and the first value of each row.
  struct Rows {
    std::vector<int> first{0}, begin{0};
    std::vector<SolverNumber> column;
    std::vector<bool> written;
  };
  struct Pair {
    bool other;
    LocalNode row;
    SolverNumber column;
    auto operator<=>(const Pair&) const = default;
  };

  int size(SolverNumber number) const { return network_.blocks.size(number); }

  const partition::LocalNetwork& network_;
  std::vector<Pair> noted_;
  std::array<Rows, 2> rows_;   ///< columns of this rank, of others
  std::vector<PairSlots> elements_;
  bool is_fixed_ = false;
};

}   // namespace cablenet::system
