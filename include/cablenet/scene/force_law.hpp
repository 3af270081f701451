#pragma once
#include <functional>
#include <vector>

#include "cablenet/base/linear_algebra.hpp"

namespace cablenet::scene {

/// A force that depends on time [N], in the world's axes.  Copies share the law.
/// Tests: tests/unit/force_law_test.cpp
class ForceLaw {
public:
  /// Straight lines between (times[i], forces[i]), and the first or last force outside of them.
  /// @pre times strictly increasing, at least one of them
  static ForceLaw rows(const std::vector<double>& times, const std::vector<Vector3>& forces);
  /// @param largest  the size that the force has at most [N]
  ForceLaw(std::function<Vector3(double t)> law, double largest) : law_(std::move(law)), largest_(largest) {}

  Vector3 at(double t) const { return law_(t); }
  double largest() const { return largest_; }

private:
  std::function<Vector3(double t)> law_;
  double largest_;
};

}   // namespace cablenet::scene
