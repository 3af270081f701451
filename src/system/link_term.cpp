#include "link_term.hpp"

#include "item_loops.hpp"

namespace cablenet::system {
namespace {

struct LinkKernel {
  using Response = ChordResponse;
  static constexpr bool owns_slots = true;

  struct Apart {
    std::array<Vector3, 2> forces;
    double stiffness;

    template <class Link>
    bool fill(const LinkKernel& kernel, std::size_t i, const Link& link, const AnyNodes& nodes) {
      ChordResponse response;
      kernel.evaluate<true, false>(i, link, nodes, Shift{}, response);
      forces = response.on;
      stiffness = link.stiffness;
      return true;
    }
    const Vector3& on(std::size_t i) const { return forces[i]; }
    double x(std::size_t i, std::size_t j) const { return i == j ? stiffness : -stiffness; }
    NoSlope v(std::size_t, std::size_t) const { return {}; }
    NoSlope a(std::size_t, std::size_t) const { return {}; }
  };

  template <bool with_residual, bool with_tangent, class Link>
  bool evaluate(std::size_t, const Link& link, const AnyNodes& nodes, const Shift&, Response& out) const {
    const Vector3 force = link.stiffness * difference(nodes.x(link.node[1]), nodes.x(link.node[0]));
    out.on = {-force, force};
    return true;
  }
};

}   // namespace

void LinkTerm::couplings(BlockPattern& pattern) {
  for (std::size_t i = 0; i < slots_.size(); ++i) slots_[i] = pattern.pair(network_.links[i].node);
}

void LinkTerm::add(Evaluation& evaluation) {
  if (slots_.empty()) return;
  add_to_pairs(evaluation, LinkKernel{}, network_.links, slots_);
}

void LinkTerm::add_energy(const LocalState& state, Energies& sum) const {
  for (int i = 0; i < network_.own_links; ++i) {
    const auto& [node, stiffness] = network_.links[at(i)];
    sum.strain += 0.5 * stiffness * (state.position(node[1]) - state.position(node[0])).squaredNorm();
  }
}

void LinkTerm::add_scales(ForceSums& sums) const {
  for (int i = 0; i < network_.own_links; ++i)
    sums.stiffness += 4 * network_.links[at(i)].stiffness * network_.links[at(i)].stiffness;
}

}   // namespace cablenet::system
