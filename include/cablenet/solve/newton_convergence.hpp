#pragma once
#include <limits>

namespace cablenet::solve {

/// Tells when Newton's residual is down to rounding, where iterating further gains nothing.
class NewtonConvergence {
public:
  /// @param noise       2-norm of a residual that is rounding alone [N]
  /// @param norm        of the residual after `iteration` corrections [N]
  /// @param is_retry    a step that failed before: its first guess may be as good as rounding allows
  /// @param same_tangent  the last correction was made with an older tangent
  bool is_at_rounding(int iteration, double norm, double noise, bool is_retry, bool same_tangent);
  /// Of the last residual over the one before it; 0 after the first.
  double contraction() const { return contraction_; }

private:
  double previous_norm_ = 0;
  double contraction_ = 0;
  double rate_ = 1;                                              ///< of a kept tangent's linear convergence
  double curvature_ = std::numeric_limits<double>::infinity();   ///< of Newton's quadratic convergence [1/N]
};

}   // namespace cablenet::solve
