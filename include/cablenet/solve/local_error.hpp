#pragma once
#include <petscvec.h>

#include <span>

#include "cablenet/base/archive.hpp"
#include "cablenet/partition/local_network.hpp"
#include "cablenet/solve/alpha_step.hpp"

namespace cablenet::solve {

/// The start of a step.
struct StepStart {
  Vec x;            ///< [m]
  Vec v;            ///< [m/s]
  Vec a;            ///< the acceleration that is kept: as AlphaStepper::a() [m/s^2]
  Vec expected_a;   ///< a guess of the step's mean acceleration, by those of the steps before [m/s^2]
  Vec own_a;        ///< the method's own acceleration, where it is centred and x1 depends on it; else null [m/s^2]
};

/// The local error of a step: the distance by which this step alone leads a node astray.
///   error = |beta + (alpha_f - alpha_m)/2 - 1/6| dt^3 |x'''|,   x''' = (a1 - a0)/(t_a1 - t_a0)
/// a0 and a1 are the accelerations that are kept before and after the step.  t_a0 and t_a1 are the times at which the
/// true motion has them.  A centred method takes the one before a0 instead of a0: what vibrates too fast for the step
/// alternates in them, and leaves no node astray.  The largest error of any node counts; attitudes of bodies do not.
///
/// Where there is no water the errors of steps add up, period by period.  So each counts over the time in which the
/// motion turns by 2 rad.  The tolerance then bounds the error of a period, within ten times its value, and not that of
/// a step.  Where there is water its drag ends what an error has begun.
///
/// Tests: tests/parallel/adaptive_test.cpp
class LocalError {
public:
  /// @param longest  over which a step's error can count; 0: each counts by itself [s]
  explicit LocalError(double longest = 0) : longest_(longest) {}

  /// Of a step that leads from `start` to x1.  [m]  Collective.
  /// @param growth  of each unknown's kept acceleration in the step before [m/s^2]; empty where it is not to count
  double estimate(const AlphaStep& step, const partition::LocalNetwork& network, const StepStart& start,
                  std::span<const double> growth, Vec x1) const;
  /// The power of the step's length that the estimate follows.
  int order() const { return longest_ > 0 ? 2 : 3; }
  /// The step is taken, whether it was estimated or not.
  void accept(const AlphaStep& step);
  void archive(Archive& archive);

private:
  double longest_;          ///< over which a step's error counts [s]
  double a_time_ = 0;       ///< t_a0, counted from the step's start [s]
  double grown_over_ = 0;   ///< t_a1 - t_a0 of the step before [s]
};

}   // namespace cablenet::solve
