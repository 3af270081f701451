#pragma once
#include "water_term.hpp"

namespace cablenet::system {

/// Drag, added mass and buoyancy of cables.  Tests: tests/parallel/surroundings_test.cpp
class CableWaterTerm : public WaterTerm {
public:
  static constexpr Account account = Account::water;
  using WaterTerm::WaterTerm;

  void add(Evaluation& evaluation);
  Vector3 end_force(const LocalState& state, int element, std::size_t end) const;
};

}   // namespace cablenet::system
