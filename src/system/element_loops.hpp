#pragma once
#include "body_scatter.hpp"
#include "cablenet/petsc/phase.hpp"

/// The program's loops over elements and over their ends.  A kernel sees its nodes' motion alone.  The loops bring its
/// forces and slopes to owned, ghost, prescribed and carried nodes.
namespace cablenet::system {

using partition::Range;

/// Elements between owned nodes first: the ghosts' motion arrives meanwhile.
/// @param visit  called with a range of elements and the scatter that serves them
template <class Kernel, class Visit>
void visit_ranges(Evaluation& evaluation, const Kernel& kernel, const Shift& shift, const Visit& visit) {
  const partition::LocalNetwork& network = evaluation.network;
  const petsc::Phase phase = evaluation.has_residual ? petsc::Phase::residual : petsc::Phase::tangent;
  visit_parts(evaluation, [&]<bool with_residual, bool with_tangent>() {
    const auto scatter = [&]<class Nodes>(const Nodes& nodes) {
      return Scatter<with_residual, with_tangent, Nodes, Kernel>{kernel, nodes, evaluation.target, shift};
    };
    {
      const petsc::Timer timer(phase);
      visit(Range{0, network.inner_elements}, scatter(InnerNodes{evaluation.data}));
    }
    evaluation.complete();
    const petsc::Timer timer(phase);
    const auto [first, last] = network.attached;
    visit(Range{network.inner_elements, first}, scatter(AnyNodes{evaluation.data}));
    if (first < last) visit(Range{first, last}, BodyScatter<with_tangent, Kernel>(evaluation, kernel, shift));
    visit(Range{last, static_cast<int>(network.elements.size())}, scatter(AnyNodes{evaluation.data}));
  });
}

/// A kernel of two nodes on all elements.
template <class Kernel>
void add_to_elements(Evaluation& evaluation, const Kernel& kernel, const Shift& shift) {
  const partition::LocalNetwork& network = evaluation.network;
  const PairSlots* const slots = evaluation.target.elements;
  visit_ranges(evaluation, kernel, shift, [&](Range range, const auto scatter) {
    for (std::size_t i = at(range.first); i < at(range.last); ++i) {
      if (scatter.pair(i, network.elements[i], slots[i])) continue;
      evaluation.in_domain = false;
      evaluation.coincident = network.scene_element[i];
      return;
    }
  });
}

/// A kernel of one node on both ends of all elements.  It is told 2 element + end.
template <class Kernel>
void add_to_ends(Evaluation& evaluation, const Kernel& kernel, const Shift& shift) {
  const partition::LocalNetwork& network = evaluation.network;
  const PairSlots* const slots = evaluation.target.elements;
  visit_ranges(evaluation, kernel, shift, [&](Range range, const auto scatter) {
    for (std::size_t i = at(range.first); i < at(range.last); ++i)
      for (std::size_t k = 0; k < 2; ++k)
        scatter.node(2 * i + k, scatter.nodes.key(network.elements[i], k), slots[i][3 * k]);
  });
}

}   // namespace cablenet::system
