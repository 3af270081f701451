#pragma once
#include <vector>

#include "term.hpp"

namespace cablenet::system {

/// Stiff links between a cable's end node and the attachment that a body carries: force = stiffness * gap.  All
/// schemes take it at the stage, as it is linear in positions.  Tests: tests/parallel/bodies_test.cpp
class LinkTerm : public Term {
public:
  using Term::Term;

  void couplings(BlockPattern& pattern) { slots_ = pattern.pairs(network_.links); }
  void add(Evaluation& evaluation);
  void add_energy(const LocalState& state, Energies& sum) const;
  void add_scales(const LocalState&, ForceSums& sums) const;

private:
  std::vector<PairSlots> slots_;
};

}   // namespace cablenet::system
