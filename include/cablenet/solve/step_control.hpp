#pragma once
#include <string>

#include "cablenet/base/archive.hpp"

/// Chooses the length of adaptive steps by the local error of the steps before (local_error.hpp).
/// Tests: tests/parallel/adaptive_test.cpp
namespace cablenet::solve {

/// The step is halved, doubled and made four times as long, never changed a little: a tangent can be kept as long as
/// the step stays.  It grows to what goes 1, 2, 4 or 8 times into the longest step.
class StepControl {
public:
  /// The length of the next attempt over that of one whose error was too large.
  static constexpr double refused_scale = 0.5;

  /// @param tolerance  that the local error of a step may reach [m], > 0
  /// @param first      the first step [s]
  /// @param longest    the longest step that is of use [s]
  /// @param shortest   a step shorter than this is taken whatever its error is [s]
  /// @param order      the power of the step's length that the error follows
  StepControl(double tolerance, double first, double longest, double shortest, int order);

  /// Judges an attempt.  @returns false if a shorter one has to be made
  /// @param error [m]  @param dt [s]
  bool accepts(double error, double dt);
  /// The attempt that was judged last is the step.
  /// @param retried  there were attempts before it
  void advance(bool retried);

  /// How long the next step may be [s].
  double limit() const { return limit_; }
  /// Why no step longer than `dt` could be taken, if the error was the reason; else empty.
  std::string refusal(double dt) const;
  void archive(Archive& archive);

private:
  double fitting(double most) const;
  double longer() const;

  double tolerance_, limit_, longest_, shortest_;
  int order_;
  double error_ = 0, dt_ = 0;                   ///< of the last attempt
  double refused_error_ = 0, refused_dt_ = 0;   ///< of the last attempt that was refused
  int growing_ = 0;                             ///< steps in a row that could have grown
};

}   // namespace cablenet::solve
