#pragma once
#include <unordered_map>
#include <vector>

#include "term.hpp"

namespace cablenet::system {

/// Point masses and constant forces at nodes, those of bodies' centres of gravity among them: m (a + g) - F.
/// Tests: tests/parallel/assembler_test.cpp
class PointTerm : public Term {
public:
  explicit PointTerm(const partition::LocalNetwork& network);

  void couplings(BlockPattern& pattern);
  void add(Evaluation& evaluation);
  void add_energy(const LocalState& state, Energies& sum) const;
  void add_scales(ForceSums& sums) const;
  Vector3 node_force(const LocalState& state, LocalNode node) const;

private:
  const partition::LocalNetwork& network_;
  std::vector<Slot> slots_;
  std::unordered_map<int, std::size_t> load_at_;   ///< by local node: an index into LocalNetwork::loads
};

}   // namespace cablenet::system
