#pragma once
#include <vector>

#include "carried_kernels.hpp"

/// The loops over what is not an element: items with one node or two.
namespace cablenet::system {

/// A kernel of two nodes on items that have two, of which one at least is carried.
template <class Kernel, class Item>
void add_to_pairs(Evaluation& evaluation, const Kernel& kernel, const std::vector<Item>& items,
                  const std::vector<PairSlots>& slots) {
  evaluation.complete();
  const CarriedScatter scatter(evaluation);
  visit_parts(evaluation, [&]<bool, bool with_tangent>() {
    for (std::size_t i = 0; i < items.size(); ++i)
      add_carried_pair<with_tangent>(scatter, kernel, i, items[i], slots[i], evaluation.target.shift);
  });
}

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
