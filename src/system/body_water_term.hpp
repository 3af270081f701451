#pragma once
#include "body_term.hpp"
#include "cablenet/bodies/body_in_water.hpp"
#include "water_choice.hpp"

namespace cablenet::system {

/// Drag and added mass of bodies at their centres of gravity.  Tests: tests/parallel/surroundings_test.cpp
class BodyWaterTerm : public Term {
public:
  explicit BodyWaterTerm(const partition::LocalNetwork& network) : network_(network), water_(network.surroundings) {}

  bool has_rates() const { return water_.exists(); }
  bool is_symmetric(const ForceRule&) const { return !water_.exists(); }
  void add(Evaluation& evaluation);

private:
  void add_slopes(int body, const bodies::BodyLoad& load, const Matrix3& R, Evaluation& evaluation) const;

  const partition::LocalNetwork& network_;
  WaterChoice water_;
};

}   // namespace cablenet::system
