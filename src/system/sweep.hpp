#pragma once
#include <type_traits>

#include "access.hpp"
#include "attached_work.hpp"
#include "body_set.hpp"
#include "cablenet/petsc/phase.hpp"
#include "element_loop.hpp"
#include "starts.hpp"

/// One evaluation of all elements, links and bodies by a force law.
namespace cablenet::system {

template <class Law>
void Assembler::record_starts(const Law&, const Access& access) {
  if constexpr (!std::is_same_v<typename Law::Start, NoStart>) {
    auto& starts = starts_->of<Law>(network_.elements.size());
    const auto record = [&](Range range, auto nodes) {
      for_each_element(network_, range, [&](std::size_t i, const partition::LocalElement& e) {
        const auto n1 = nodes.name(e, 0), n2 = nodes.name(e, 1);
        Vector3 w = Vector3::Zero();
        if constexpr (Law::general) w = difference(nodes.v(n2), nodes.v(n1));
        starts[i] = Law::start(network_.materials[static_cast<std::size_t>(e.material)], e.length,
                               difference(nodes.x(n2), nodes.x(n1)), w);
        return true;
      });
    };
    record({0, network_.inner_elements}, InnerNodes{access.data});
    record({network_.inner_elements, static_cast<int>(network_.elements.size())}, AnyNodes{access.data});
  }
}

/// Elements between owned nodes first: the ghosts' motion arrives meanwhile.
template <class Law, bool with_residual, bool with_tangent>
bool Assembler::sweep(const Law& law, const Stage& stage, Access& access, const TangentRequest* request) {
  const auto& starts = starts_->of<Law>(network_.elements.size());
  TangentTarget target{};
  if constexpr (with_tangent)
    target = {request->matrix.open(), request->matrix.element_slots().data(), request->shift_v, request->shift_a};
  const auto visit = [&](Range range, auto nodes) {
    const ElementWork<Law, decltype(nodes), with_residual, with_tangent> work{network_, law, starts.data(), nodes,
                                                                              target};
    return for_each_element(network_, range, [&](std::size_t i, const partition::LocalElement& e) {
      if (work(i, e)) return true;
      coincident_ = network_.scene_element[i];
      return false;
    });
  };
  constexpr petsc::Phase phase = with_residual ? petsc::Phase::residual : petsc::Phase::tangent;
  const auto timed_visit = [&](Range range, auto nodes) {
    const petsc::Timer timer(phase);
    return visit(range, nodes);
  };
  bool in_domain = timed_visit({0, network_.inner_elements}, InnerNodes{access.data});
  access.finish_exchange();
  in_domain = timed_visit({network_.inner_elements, network_.attached.first}, AnyNodes{access.data}) && in_domain;
  if (!bodies_->empty()) in_domain = sweep_bodies<Law, with_tangent>(law, stage, access, request) && in_domain;
  const Range copies{network_.attached.last, static_cast<int>(network_.elements.size())};
  in_domain = timed_visit(copies, AnyNodes{access.data}) && in_domain;
  if (!network_.surroundings.empty()) add_surroundings(stage, access, request);
  if constexpr (with_tangent) request->matrix.close();
  return in_domain;
}

/// Elements and links at the nodes that bodies carry.
template <class Law, bool with_tangent>
bool Assembler::sweep_bodies(const Law& law, const Stage& stage, Access& access, const TangentRequest* request) {
  const petsc::Timer timer(access.has_residual() ? petsc::Phase::residual : petsc::Phase::tangent);
  const AnyNodes nodes{access.data};
  TangentTarget target{};
  Shift shift;
  if constexpr (with_tangent) {
    target = {request->matrix.values(), request->matrix.element_slots().data(), request->shift_v, request->shift_a};
    shift = {request->shift_x, request->shift_v, request->shift_a};
  }
  bool in_domain = bodies_->place(stage, conserves(stage), access.data, with_tangent ? &shift : nullptr);
  const AttachedBlocks blocks(network_, *bodies_, target);
  const AttachedWork<Law, with_tangent> work{network_, law,    starts_->of<Law>(network_.elements.size()).data(),
                                             nodes,    target, blocks};
  in_domain = for_each_element(network_, network_.attached,
                               [&](std::size_t i, const partition::LocalElement& e) {
                                 if (work(i, e)) return true;
                                 coincident_ = network_.scene_element[i];
                                 return false;
                               }) &&
              in_domain;
  add_links(network_, nodes, request, blocks);
  return in_domain;
}

template <class Law>
bool Assembler::run(const Law& law, const Stage& stage, Access& access, const TangentRequest* request) {
  const auto sweep_all = [&] {
    if (!access.has_residual()) return sweep<Law, false, true>(law, stage, access, request);
    return request == nullptr ? sweep<Law, true, false>(law, stage, access, nullptr)
                              : sweep<Law, true, true>(law, stage, access, request);
  };
  const bool in_domain = sweep_all();
  if (!bodies_->empty())
    bodies_->collect(access.data, request != nullptr ? &request->matrix : nullptr,
                     request != nullptr ? request->steadiness : 0);
  return in_domain;
}

}   // namespace cablenet::system
