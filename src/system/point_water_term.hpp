#pragma once
#include <vector>

#include "term.hpp"
#include "water_choice.hpp"

namespace cablenet::system {

/// Drag, added mass and buoyancy of points and of bodies' centres of buoyancy, which bodies carry.
/// Tests: tests/parallel/surroundings_test.cpp
class PointWaterTerm : public Term {
public:
  explicit PointWaterTerm(const partition::LocalNetwork& network)
      : network_(network), water_(network.surroundings), slots_(network.wet_points.size()) {}

  void couplings(BlockPattern& pattern);
  bool has_rates() const { return water_.exists(); }
  bool is_symmetric(const ForceRule&) const { return !water_.exists(); }
  void add(Evaluation& evaluation);

private:
  const partition::LocalNetwork& network_;
  WaterChoice water_;
  std::vector<Slot> slots_;
};

}   // namespace cablenet::system
