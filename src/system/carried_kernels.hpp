#pragma once
#include "carried_scatter.hpp"

/// What a kernel does where a body carries its nodes.
namespace cablenet::system {

/// @returns false where the kernel is not defined
template <bool with_tangent, class Kernel, class Item>
bool add_carried_pair(const CarriedScatter& scatter, const Kernel& kernel, std::size_t i, const Item& item,
                      const PairSlots& slots, const Shift& shift) {
  if constexpr (with_tangent) {
    typename Kernel::Apart by;
    if (!by.fill(kernel, i, item, scatter.nodes)) return false;
    for (std::size_t k = 0; k < 2; ++k) scatter.add_force(item.node[k], by.on(k));
    scatter.template add_pair<Kernel::owns_slots>(item.node, slots, by, shift);
  } else {
    typename Kernel::Response response;
    if (!kernel.template evaluate<true, false>(i, item, scatter.nodes, shift, response)) return false;
    for (std::size_t k = 0; k < 2; ++k) scatter.add_force(item.node[k], response.on[k]);
  }
  return true;
}

template <bool with_tangent, class Kernel>
void add_carried_node(const CarriedScatter& scatter, const Kernel& kernel, std::size_t i, LocalNode node,
                      const Slot& slot, const Shift& shift) {
  NodeResponse by;
  if (!kernel.template evaluate<with_tangent>(i, node, scatter.nodes, by)) return;
  scatter.add_force(node, by.on);
  if constexpr (with_tangent) scatter.template add_block<Kernel::owns_slots>(node, node, slot, by.x, by.v, by.a, shift);
}

}   // namespace cablenet::system
