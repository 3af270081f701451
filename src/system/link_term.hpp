#pragma once
#include <vector>

#include "term.hpp"

namespace cablenet::system {

/// Stiff links between a cable's end node and the attachment that a body carries: force = stiffness * gap.  All
/// schemes take it at the stage, as it is linear in positions.  Tests: tests/parallel/bodies_test.cpp
class LinkTerm : public Term {
public:
  explicit LinkTerm(const partition::LocalNetwork& network) : network_(network), slots_(network.links.size()) {}

  void couplings(BlockPattern& pattern);
  void add(Evaluation& evaluation);
  void add_energy(const LocalState& state, Energies& sum) const;
  void add_scales(ForceSums& sums) const;

private:
  const partition::LocalNetwork& network_;
  std::vector<PairSlots> slots_;
};

}   // namespace cablenet::system
