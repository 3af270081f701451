#pragma once
#include <array>

namespace cablenet::solve {

/// Watches the residuals of one solve by Newton's method.  Tests: tests/parallel/tangent_reuse_test.cpp
class NewtonProgress {
public:
  /// After each correction, and before the first one.
  /// @param iteration  corrections so far   @param norm  of the residual after them [N]
  /// @param noise      norms up to this may be rounding, and return by chance [N]
  void note(int iteration, double norm, double noise);
  /// Within the last corrections a residual was best, or two in a row fell by 30 %.
  bool goes_on() const { return iteration_ - gained_at_ < patience; }
  /// The last residual is the first one, or 30 % below the best one before it.
  bool is_best() const { return is_best_; }
  /// The last residual is the one of two corrections before, or exactly one of some corrections before: elements go
  /// slack and taut by turns, or stick and slip.
  bool returns() const { return returns_; }
  /// A residual of this solve has returned, and the last one is not far below it.
  bool cycles() const { return cycles_; }

private:
  static constexpr int patience = 12;

  int iteration_ = 0, gained_at_ = 0, falls_ = 0;
  double best_ = 0, cycled_at_ = 0;   ///< [N]
  std::array<double, 8> before_{};    ///< the last residuals, the latest first [N]
  bool is_best_ = false, returns_ = false, cycles_ = false;
};

}   // namespace cablenet::solve
