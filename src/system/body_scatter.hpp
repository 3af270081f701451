#pragma once
#include "carried_scatter.hpp"

namespace cablenet::system {

/// What a kernel does where a body carries its nodes, as Scatter does it elsewhere.
template <bool with_tangent, class Kernel>
struct BodyScatter : CarriedScatter {
  BodyScatter(const Evaluation& evaluation, const Kernel& physics, const Shift& by)
      : CarriedScatter(evaluation), kernel(physics), shift(by) {}

  template <class Item>
  bool pair(std::size_t i, const Item& item, const PairSlots& slots) const {
    if constexpr (with_tangent) {
      typename Kernel::Apart by;
      if (!by.fill(kernel, i, item, nodes)) return false;
      for (std::size_t k = 0; k < 2; ++k) add_force(item.node[k], by.on(k));
      add_pair<Kernel::owns_slots>(item.node, slots, by, shift);
    } else {
      typename Kernel::Response response;
      if (!kernel.template evaluate<true, false>(i, item, nodes, shift, response)) return false;
      for (std::size_t k = 0; k < 2; ++k) add_force(item.node[k], response.on[k]);
    }
    return true;
  }

  void node(std::size_t i, LocalNode key, const Slot& slot) const {
    NodeResponse by;
    if (!kernel.template evaluate<with_tangent>(i, key, nodes, by)) return;
    add_force(key, by.on);
    if constexpr (with_tangent) add_block<Kernel::owns_slots>(key, key, slot, by.x, by.v, by.a, shift);
  }

  const Kernel& kernel;
  const Shift shift;
};

}   // namespace cablenet::system
