#pragma once
#include <vector>

#include "carried_kernels.hpp"

/// The loop over what is not an element: items with one node.
namespace cablenet::system {

/// A kernel of one node on items that have one each.
template <class Kernel, class Item>
void add_to_nodes(Evaluation& evaluation, const Kernel& kernel, const std::vector<Item>& items,
                  const std::vector<Slot>& slots) {
  evaluation.complete();
  const TangentTarget& target = evaluation.target;
  const CarriedScatter carried(evaluation);
  visit_parts(evaluation, [&]<bool with_residual, bool with_tangent>() {
    const AnyNodes nodes{evaluation.data};
    const NodeScatter<with_residual, with_tangent, AnyNodes, Kernel> scatter{kernel, nodes, target, target.shift};
    for (std::size_t i = 0; i < items.size(); ++i)
      if (evaluation.network.is_carried(items[i].node))
        add_carried_node<with_tangent>(carried, kernel, i, items[i].node, slots[i], target.shift);
      else
        scatter(i, items[i].node, slots[i]);
  });
}

}   // namespace cablenet::system
