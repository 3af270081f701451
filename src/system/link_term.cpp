#include "link_term.hpp"

#include <algorithm>

#include "carried_scatter.hpp"
#include "law_choice.hpp"

namespace cablenet::system {
namespace {

/// By the nodes' positions alone.
template <class Slope>
struct LinkSlopes {
  Slope same, other;   ///< of a node's force by the node itself, and by the other

  const Slope& x(std::size_t i, std::size_t j) const { return i == j ? same : other; }
  NoSlope v(std::size_t, std::size_t) const { return {}; }
  NoSlope a(std::size_t, std::size_t) const { return {}; }
};

elements::Bar bar_of(const network::Link<LocalNode>& link) { return {link.stiffness, link.bar_length}; }

}   // namespace

LinkTerm::LinkTerm(const partition::LocalNetwork& network)
    : Term(network),
      has_bars_(
          std::any_of(network.links.begin(), network.links.end(), [](const auto& link) { return link.is_bar(); })),
      starts_(network.links.size(), Vector3::Zero()) {}

void LinkTerm::begin_step(Evaluation& evaluation) {
  const AnyNodes nodes{evaluation.data};
  for (std::size_t i = 0; i < starts_.size(); ++i)
    if (const Link& link = network_.links[i]; link.is_bar()) starts_[i] = nodes.x(centre(link)) - nodes.x(link.node[0]);
}

/// With its derivative by the stage's chord.
elements::BarForce LinkTerm::bar_force(std::size_t i, const Evaluation& evaluation) const {
  const AnyNodes nodes{evaluation.data};
  const elements::Bar bar = bar_of(network_.links[i]);
  const Vector3 d = nodes.x(centre(network_.links[i])) - nodes.x(network_.links[i].node[0]);
  const Situation& situation = evaluation.situation;
  const double alpha_f = situation.stage.alpha_f;
  const auto at_end = [&] { return Vector3(starts_[i] + (d - starts_[i]) / alpha_f); };
  switch (choose_bar_law(evaluation.rule, situation)) {
    case BarLaw::conserving: {
      const elements::BarForce of_step = elements::bar_step_force(bar, starts_[i], at_end());
      return {of_step.f, 1 / alpha_f * of_step.K};
    }
    case BarLaw::averaged: {
      const elements::BarForce end = elements::bar_force(bar, at_end());
      return {(1 - alpha_f) * elements::bar_force(bar, starts_[i]).f + alpha_f * end.f, end.K};
    }
    case BarLaw::of_statics:
      return elements::bar_static_force(bar, situation.rule, starts_[i], d);
    case BarLaw::of_instant:
      return elements::bar_force(bar, d);
    case BarLaw::none:
      break;
  }
  return {Vector3::Zero(), Matrix3::Zero()};
}

void LinkTerm::add(Evaluation& evaluation) {
  if (slots_.empty()) return;
  evaluation.complete();
  const CarriedScatter scatter(evaluation);
  const auto add_link = [&](std::size_t i, const Vector3& f, const auto& slopes) {
    const auto& node = network_.links[i].node;
    scatter.add_force(node[0], -f);
    scatter.add_force(node[1], f);
    if (evaluation.has_tangent) scatter.add_pair<true>(node, slots_[i], slopes, evaluation.target.shift);
  };
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const Link& link = network_.links[i];
    if (link.is_bar()) {
      const elements::BarForce bar = bar_force(i, evaluation);
      if (!bar.f.allFinite()) evaluation.in_domain = false;
      add_link(i, bar.f, LinkSlopes<CentralSlope>{{bar.K}, {-bar.K}});
    } else {
      const double k = link.stiffness;
      add_link(i, k * (scatter.nodes.x(link.node[1]) - scatter.nodes.x(link.node[0])), LinkSlopes<double>{k, -k});
    }
  }
}

void LinkTerm::add_energy(const LocalState& state, Energies& sum) const {
  for (int i = 0; i < network_.own_links; ++i) {
    const Link& link = network_.links[at(i)];
    const Vector3 d = state.position(link.is_bar() ? centre(link) : link.node[1]) - state.position(link.node[0]);
    sum.strain += link.is_bar() ? elements::bar_energy(bar_of(link), d) : 0.5 * link.stiffness * d.squaredNorm();
  }
}

void LinkTerm::add_potential(const Situation&, const LocalState& state, double& sum) const {
  Energies energies;
  add_energy(state, energies);
  sum += energies.strain;
}

void LinkTerm::add_scales(const LocalState&, ForceSums& sums) const {
  for (int i = 0; i < network_.own_links; ++i) sums.stiffness += square(2 * network_.links[at(i)].stiffness);
}

}   // namespace cablenet::system
