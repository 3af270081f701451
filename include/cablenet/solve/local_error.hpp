#pragma once
#include <petscvec.h>

#include "cablenet/base/archive.hpp"
#include "cablenet/partition/local_network.hpp"
#include "cablenet/solve/alpha_step.hpp"

namespace cablenet::solve {

/// The start of a step.
struct StepStart {
  Vec x;   ///< [m]
  Vec v;   ///< [m/s]
  Vec a;   ///< the acceleration that is kept: the step's mean where the method's own alternates [m/s^2]
};

/// The local error of a step: the distance by which this step alone leads a node astray.
///   error = |beta + (alpha_f - alpha_m)/2 - 1/6| dt^3 |x'''|,   x''' = (a1 - a0)/(t_a1 - t_a0)
/// a0 and a1 are the accelerations that are kept before and after the step.  t_a0 and t_a1 are the times at which the
/// true motion has them.  The largest error of any node counts; attitudes of bodies do not.
/// Tests: tests/parallel/adaptive_test.cpp
class LocalError {
public:
  /// Of a step that leads from `start` to x1.  [m]  Collective.
  double estimate(const AlphaStep& step, const partition::LocalNetwork& network, const StepStart& start, Vec x1);
  /// The step that was estimated last is taken.
  void accept() { a_time_ = next_a_time_; }
  void archive(Archive& archive) { archive.item("local_error.a_time", a_time_); }

private:
  double a_time_ = 0;        ///< t_a0, counted from the step's start [s]
  double next_a_time_ = 0;   ///< t_a1, counted from the step's end [s]
};

}   // namespace cablenet::solve
