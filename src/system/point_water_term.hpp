#pragma once
#include <vector>

#include "water_term.hpp"

namespace cablenet::system {

/// Drag, added mass and buoyancy of points and of bodies' centres of buoyancy, which bodies carry.
/// Tests: tests/parallel/surroundings_test.cpp
class PointWaterTerm : public WaterTerm {
public:
  static constexpr Account account = Account::water;
  using WaterTerm::WaterTerm;

  void couplings(BlockPattern& pattern) { slots_ = pattern.own(network_.wet_points); }
  void add(Evaluation& evaluation);

private:
  std::vector<Slot> slots_;
};

}   // namespace cablenet::system
