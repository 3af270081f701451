#pragma once
#include <petscvec.h>

#include <span>
#include <vector>

#include "cablenet/base/archive.hpp"

namespace cablenet::solve {

/// The accelerations of a centred method (AlphaWeights::is_centred): the mean of the step that was taken, and the one
/// that the next step may be expected to have.  Tests: tests/parallel/dynamics_test.cpp
class MeanAcceleration {
public:
  /// At the end of a step of length dt [s] from v0 to v1 [m/s].  Each unknown of the expected acceleration grows on as
  /// a has grown in this step and in the one before, by the lesser of the two: a turning cable's does, and one that
  /// alternates stays.  So the next first guess turns with the cable, which keeps stiff elements' lengths.
  /// @param a         the mean of the step before, and what becomes of it: (v1 - v0)/dt [m/s^2]
  /// @param expected  [m/s^2]
  void advance(double dt, Vec v0, Vec v1, Vec a, Vec expected);
  /// Of each unknown in the last step; empty before it.  [m/s^2]
  std::span<const double> growth() const { return growth_; }
  void archive(Archive& archive) { archive.item("mean_acceleration.growth", growth_); }

private:
  std::vector<double> growth_;   ///< of each unknown in the last step [m/s^2]
};

}   // namespace cablenet::solve
