#pragma once
#include <vector>

#include "term.hpp"

namespace cablenet::system {

/// Point masses and constant forces at nodes, those of bodies' centres of gravity among them: m (a + g) - F.
/// Tests: tests/parallel/assembler_test.cpp
class PointTerm : public Term {
public:
  using Term::Term;

  void couplings(BlockPattern& pattern) { slots_ = pattern.own(network_.loads); }
  void add(Evaluation& evaluation);
  void add_energy(const LocalState& state, Energies& sum) const;
  void add_scales(const LocalState&, ForceSums& sums) const;
  Vector3 node_force(const LocalState& state, LocalNode node) const;

private:
  std::vector<Slot> slots_;
};

}   // namespace cablenet::system
