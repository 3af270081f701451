#pragma once
#include <petscts.h>

#include <string>

#include "cablenet/partition/local_network.hpp"
#include "cablenet/solve/alpha_step.hpp"

/// How long a step may be for its local error, the distance by which it alone leads a node astray.
///   error = |beta + (alpha_f - alpha_m)/2 - 1/6| dt^3 |x'''|,  x''' = (a1 - a0)/(t_a1 - t_a0)
/// where a0 and a1 are the accelerations kept before and after the step, and t_a the times at which they are those of
/// the motion.  Attitudes do not count.  Tests: tests/parallel/adaptive_test.cpp
namespace cablenet::solve {

/// A step's start: x [m], v [m/s] and the acceleration kept then, the mean where TSALPHA2's own alternates [m/s^2].
struct StepStart {
  Vec x, v, a;
};

/// Steps are halved and doubled, so that a tangent serves many.
class StepControl {
public:
  /// @param tolerance  of the local error [m], > 0
  /// @param first      of the steps asked for [s]
  /// @param longest    useful one [s]
  /// @param shortest   that is rejected [s]
  StepControl(TSAdapt adapt, double tolerance, double first, double longest, double shortest);

  /// Before each attempt: failures of Newton's shorten the step as the user has it.
  void begin_attempt();
  /// Is the step to x1 within the tolerance?  If not, PETSc's next attempt takes half the step.  Collective.
  bool accepts(const AlphaStep& step, const partition::LocalNetwork& network, const StepStart& start, Vec x1);
  /// The step that was accepted last has been taken.
  /// @param retried  after attempts that failed or were rejected
  void advance(bool retried);

  /// The longest next step [s].
  double limit() const { return limit_; }
  /// Of the last attempt [m].
  double error() const { return error_; }
  /// What forbade a step longer than `dt`, if that was its local error; else empty.
  std::string refusal(double dt) const;

private:
  TSAdapt adapt_;
  PetscReal newton_scale_ = 0;   ///< of a step that Newton's method failed with
  double tolerance_, limit_, longest_, shortest_;
  double error_ = 0;
  double dt_ = 0;                               ///< of the last attempt
  double refused_error_ = 0, refused_dt_ = 0;   ///< of the last attempt beyond the tolerance
  double a_time_ = 0;                           ///< of the acceleration kept, from the last step's end [s]
  double next_a_time_ = 0;                      ///< likewise if the last attempt is taken
  int growing_ = 0;                             ///< steps since the last change for which twice the limit would do
};

}   // namespace cablenet::solve
