#pragma once
#include <vector>

#include "body_scatter.hpp"

namespace cablenet::system {

/// A kernel of one node on items that have one each.
template <class Kernel, class Item>
void add_to_nodes(Evaluation& evaluation, const Kernel& kernel, const std::vector<Item>& items,
                  const std::vector<Slot>& slots) {
  evaluation.complete();
  const TangentTarget& target = evaluation.target;
  visit_parts(evaluation, [&]<bool with_residual, bool with_tangent>() {
    const Scatter<with_residual, with_tangent, AnyNodes, Kernel> plain{kernel, {evaluation.data}, target, target.shift};
    const BodyScatter<with_tangent, Kernel> carried(evaluation, kernel, target.shift);
    for (std::size_t i = 0; i < items.size(); ++i)
      if (evaluation.network.is_carried(items[i].node))
        carried.node(i, items[i].node, slots[i]);
      else
        plain.node(i, items[i].node, slots[i]);
  });
}

}   // namespace cablenet::system
