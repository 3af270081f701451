#pragma once
#include "body_term.hpp"
#include "cablenet/bodies/body_in_water.hpp"
#include "water_term.hpp"

namespace cablenet::system {

/// Drag and added mass of bodies at their centres of gravity.  Tests: tests/parallel/surroundings_test.cpp
class BodyWaterTerm : public WaterTerm {
public:
  static constexpr Account account = Account::water;
  using WaterTerm::WaterTerm;

  void add(Evaluation& evaluation);

private:
  void add_slopes(int body, const bodies::BodyLoad& load, const Matrix3& R, Evaluation& evaluation) const;
};

}   // namespace cablenet::system
