#include "link_term.hpp"

#include "carried_scatter.hpp"

namespace cablenet::system {
namespace {

/// By the nodes' positions alone.
struct LinkSlopes {
  double stiffness;

  double x(std::size_t i, std::size_t j) const { return i == j ? stiffness : -stiffness; }
  NoSlope v(std::size_t, std::size_t) const { return {}; }
  NoSlope a(std::size_t, std::size_t) const { return {}; }
};

}   // namespace

void LinkTerm::add(Evaluation& evaluation) {
  if (slots_.empty()) return;
  evaluation.complete();
  const CarriedScatter scatter(evaluation);
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const auto& [node, stiffness] = network_.links[i];
    const Vector3 force = stiffness * (scatter.nodes.x(node[1]) - scatter.nodes.x(node[0]));
    scatter.add_force(node[0], -force);
    scatter.add_force(node[1], force);
    if (evaluation.has_tangent) scatter.add_pair<true>(node, slots_[i], LinkSlopes{stiffness}, evaluation.target.shift);
  }
}

void LinkTerm::add_energy(const LocalState& state, Energies& sum) const {
  for (int i = 0; i < network_.own_links; ++i) {
    const auto& [node, stiffness] = network_.links[at(i)];
    sum.strain += 0.5 * stiffness * (state.position(node[1]) - state.position(node[0])).squaredNorm();
  }
}

void LinkTerm::add_scales(const LocalState&, ForceSums& sums) const {
  for (int i = 0; i < network_.own_links; ++i) sums.stiffness += square(2 * network_.links[at(i)].stiffness);
}

}   // namespace cablenet::system
