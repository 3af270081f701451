#pragma once
#include <limits>

#include "cablenet/base/archive.hpp"

namespace cablenet::solve {

/// Tells when the residual of Newton's method is down to rounding: further iterations would gain nothing.
/// Tests: tests/parallel/tangent_reuse_test.cpp
class NewtonConvergence {
public:
  /// A residual of so many times the noise may be noise alone.
  static constexpr double most_of_noise = 8;

  /// Before a solve.
  /// @param farther  CurvatureProbe::farther().  A solve whose guess was moved shows what is hidden in the others
  void begin_solve(double farther) { farther_ = farther; }
  /// @param iteration     corrections so far
  /// @param norm          2-norm of the residual after them [N]
  /// @param correction    2-norm of the last one of them [m]
  /// @param noise         2-norm of a residual that is rounding alone [N]
  /// @param searches      a search chooses the corrections' lengths.  It cannot go below rounding, so that a residual
  ///                      near `noise` is enough, that of the first guess included
  /// @param same_tangent  the last correction was made with an older tangent
  bool is_at_rounding(int iteration, double norm, double correction, double noise, bool searches, bool same_tangent);
  /// The last residual's norm over that of the one before it; 0 after the first.
  double contraction() const { return contraction_; }
  /// The first correction brought the residual down to rounding.  It may have left an error that rounding hides.
  bool was_in_doubt() const { return was_in_doubt_; }
  void archive(Archive& archive);

private:
  /// What first corrections leave, by a guess that was moved.
  struct Hidden {
    double error = std::numeric_limits<double>::infinity();   ///< [N]
    double guess = 0;                                         ///< 2-norm of the residual before it [N]
    double correction = 0;                                    ///< [m]
  };

  bool ends_at_once(double norm, double previous, double correction, double noise);
  double hidden_error(double previous, double correction) const;
  void note_curvature(double norm, double previous, double noise);

  Hidden hidden_;
  double farther_ = 1;
  bool was_in_doubt_ = false;
  double previous_norm_ = 0;
  double contraction_ = 0;
  double rate_ = 1;                                              ///< of a kept tangent's linear convergence
  double curvature_ = std::numeric_limits<double>::infinity();   ///< of Newton's quadratic convergence [1/N]
  bool has_seen_curvature_ = false;                              ///< in a residual above rounding
};

}   // namespace cablenet::solve
