#pragma once
#include <vector>

#include "cablenet/elements/bar.hpp"
#include "term.hpp"

namespace cablenet::system {

/// Links hold a cable's end at a body: springs lead to the attachment, bars to the centre of gravity.
/// A spring's force is stiffness * gap.  All schemes take it at the stage, as it is linear in positions.
/// A bar's force f is that of the chord from the cable's end to the centre of gravity, by choose_bar_law().  It acts on
/// the cable's end and, turned round, on the attachment.  It follows the centre of gravity and not the attachment.
/// Tests: tests/parallel/bodies_test.cpp, tests/verification/bars.py
class LinkTerm : public Term {
public:
  explicit LinkTerm(const partition::LocalNetwork& network);

  /// Bodies with an attitude speak for themselves.
  bool is_symmetric(const ForceRule& rule) const { return !has_bars_ || !rule.is_two_ended(); }
  void couplings(BlockPattern& pattern) { slots_ = pattern.pairs(network_.links); }
  void begin_step(Evaluation& evaluation);
  void add(Evaluation& evaluation);
  void add_energy(const LocalState& state, Energies& sum) const;
  void add_potential(const Situation&, const LocalState& state, double& sum) const;
  void add_scales(const LocalState&, ForceSums& sums) const;

private:
  using Link = network::Link<LocalNode>;

  /// The centre of gravity of the body that carries the link's attachment.
  LocalNode centre(const Link& link) const { return network_.bodies[at(network_.carried_at(link.node[1]).body)].node; }
  elements::BarForce bar_force(std::size_t link, const Evaluation& evaluation) const;

  bool has_bars_;
  std::vector<Vector3> starts_;   ///< per link: a bar's chord at the step's start [m]
  std::vector<PairSlots> slots_;
};

}   // namespace cablenet::system
