#pragma once

namespace cablenet::system {

/// A stage of a step from t to t + dt [s].  The stage's positions are x + alpha_f (x1 - x), its velocities alike.
/// An instant has dt = alpha_f = 0.
struct Stage {
  double t = 0;
  double dt = 0;
  double alpha_f = 0;

  /// At which loads are taken [s].
  double time() const { return t + alpha_f * dt; }
  bool operator==(const Stage&) const = default;
};

}   // namespace cablenet::system
