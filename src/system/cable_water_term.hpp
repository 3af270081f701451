#pragma once
#include "term.hpp"
#include "water_choice.hpp"

namespace cablenet::system {

/// Drag, added mass and buoyancy of cables.  Tests: tests/parallel/surroundings_test.cpp
class CableWaterTerm : public Term {
public:
  explicit CableWaterTerm(const partition::LocalNetwork& network) : network_(network), water_(network.surroundings) {}

  bool has_rates() const { return water_.exists(); }
  bool is_symmetric(const ForceRule&) const { return !water_.exists(); }
  void add(Evaluation& evaluation);
  Vector3 end_force(const LocalState& state, int element, std::size_t end) const;

private:
  const partition::LocalNetwork& network_;
  WaterChoice water_;
};

}   // namespace cablenet::system
