#pragma once
#include "cablenet/petsc/phase.hpp"
#include "carried_kernels.hpp"

/// The program's loops over elements and over their ends.  A kernel sees its nodes' motion alone.  The loops bring its
/// forces and slopes to owned, ghost, prescribed and carried nodes.
namespace cablenet::system {

using partition::Range;

/// @param visit  bool(element index, element); false ends the loop
template <class Visit>
bool for_each_element(const partition::LocalNetwork& network, Range range, Visit&& visit) {
  for (std::size_t i = at(range.first); i < at(range.last); ++i)
    if (!visit(i, network.elements[i])) return false;
  return true;
}

/// Elements between owned nodes first: the ghosts' motion arrives meanwhile.
/// @param visit  called with a range and its nodes   @param visit_carried  with the range of those at bodies
template <class Visit, class VisitCarried>
void for_each_range(Evaluation& evaluation, const Visit& visit, const VisitCarried& visit_carried) {
  const partition::LocalNetwork& network = evaluation.network;
  const petsc::Phase phase = evaluation.has_residual ? petsc::Phase::residual : petsc::Phase::tangent;
  const AnyNodes any{evaluation.data};
  {
    const petsc::Timer timer(phase);
    visit(Range{0, network.inner_elements}, InnerNodes{evaluation.data});
  }
  evaluation.complete();
  const petsc::Timer timer(phase);
  visit(Range{network.inner_elements, network.attached.first}, any);
  if (network.attached.first < network.attached.last) visit_carried(network.attached);
  visit(Range{network.attached.last, static_cast<int>(network.elements.size())}, any);
}

/// A kernel of two nodes on all elements.
template <class Kernel>
void add_to_elements(Evaluation& evaluation, const Kernel& kernel, const Shift& shift) {
  const partition::LocalNetwork& network = evaluation.network;
  const PairSlots* const slots = evaluation.target.elements;
  const auto fails = [&](std::size_t i) {
    evaluation.coincident = network.scene_element[i];
    return evaluation.in_domain = false;
  };
  visit_parts(evaluation, [&]<bool with_residual, bool with_tangent>() {
    const auto visit = [&]<class Nodes>(Range range, const Nodes& nodes) {
      const PairScatter<with_residual, with_tangent, Nodes, Kernel> scatter{kernel, nodes, evaluation.target, shift};
      for_each_element(network, range, [&](std::size_t i, const partition::LocalElement& e) {
        return scatter(i, e, slots[i]) || fails(i);
      });
    };
    for_each_range(evaluation, visit, [&](Range range) {
      const CarriedScatter scatter(evaluation);
      for_each_element(network, range, [&](std::size_t i, const partition::LocalElement& e) {
        return add_carried_pair<with_tangent>(scatter, kernel, i, e, slots[i], shift) || fails(i);
      });
    });
  });
}

/// A kernel of one node on both ends of all elements.
template <class Kernel>
void add_to_ends(Evaluation& evaluation, const Kernel& kernel, const Shift& shift) {
  const partition::LocalNetwork& network = evaluation.network;
  const PairSlots* const slots = evaluation.target.elements;
  visit_parts(evaluation, [&]<bool with_residual, bool with_tangent>() {
    const auto visit = [&]<class Nodes>(Range range, const Nodes& nodes) {
      const NodeScatter<with_residual, with_tangent, Nodes, Kernel> scatter{kernel, nodes, evaluation.target, shift};
      for_each_element(network, range, [&](std::size_t i, const partition::LocalElement& e) {
        for (std::size_t k = 0; k < 2; ++k) scatter(i, nodes.key(e, k), slots[i][3 * k]);
        return true;
      });
    };
    for_each_range(evaluation, visit, [&](Range range) {
      const CarriedScatter scatter(evaluation);
      for_each_element(network, range, [&](std::size_t i, const partition::LocalElement& e) {
        for (std::size_t k = 0; k < 2; ++k)
          add_carried_node<with_tangent>(scatter, kernel, i, e.node[k], slots[i][3 * k], shift);
        return true;
      });
    });
  });
}

}   // namespace cablenet::system
