#pragma once
#include <array>

namespace cablenet::solve {

/// Watches the residuals of one solve by Newton's method.  Tests: tests/parallel/tangent_reuse_test.cpp
class NewtonProgress {
public:
  /// After each correction, and before the first one.
  /// @param iteration  corrections so far   @param norm  of the residual after them [N]
  void note(int iteration, double norm);
  /// The residual has fallen by 30 % within the last corrections.
  bool goes_on() const { return iteration_ - best_at_ < patience; }
  /// The last residual is 30 % below the best one before it, or the first one.
  bool is_best() const { return best_at_ == iteration_; }
  /// The last residual is the one of two corrections before: an element goes slack and taut by turns.
  bool returns() const { return returns_; }
  /// A residual of this solve has returned.
  bool cycles() const { return cycles_; }

private:
  static constexpr int patience = 12;

  int iteration_ = 0, best_at_ = 0;
  double best_ = 0;                  ///< [N]
  std::array<double, 2> before_{};   ///< the last two residuals [N]
  bool returns_ = false, cycles_ = false;
};

}   // namespace cablenet::solve
