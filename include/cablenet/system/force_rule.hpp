#pragma once
#include "cablenet/elements/cable_data.hpp"
#include "cablenet/scene/time.hpp"

namespace cablenet::system {

struct Stage;

/// How a scheme takes the internal force over a step.  src/system/law_choice.cpp is the one place that tells schemes
/// apart.
struct ForceRule {
  scene::Scheme scheme = scene::Scheme::energy_momentum;
  double axial_dissipation = 0;   ///< xi, of energy_momentum only
  elements::Tangent tangent = elements::Tangent::exact;

  /// The force depends on both ends of the step, which makes the tangent unsymmetric.
  bool is_two_ended() const;
  /// The scheme's accelerations are the means (v1 - v0)/dt.
  bool has_mean_acceleration() const;
  /// Bodies may be taken from end to end of a step with this stage.  @param in_water there is a fluid
  bool conserves(const Stage& stage, bool in_water) const;
};

}   // namespace cablenet::system
