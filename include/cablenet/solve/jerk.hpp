#pragma once
#include <Eigen/Core>

#include "cablenet/base/archive.hpp"
#include "cablenet/solve/alpha_step.hpp"

/// The third derivative of a motion over a step, by the accelerations that are kept.
/// Tests: tests/parallel/adaptive_test.cpp
namespace cablenet::solve {

/// The steps to which the kept accelerations belong.
struct KeptSteps {
  double time = 0;     ///< when the true motion had the last kept acceleration, from the step's start on [s]
  double last = 0;     ///< length of the step before; 0: there was none, and the start's acceleration is kept [s]
  double before = 0;   ///< length of the one before that; likewise [s]

  /// What becomes of them when a step is taken.
  KeptSteps after(const AlphaStep& step) const;
  void archive(Archive& archive);
};

/// x''' and an x'' in which nothing alternates follow from the motion of a step:
///   x''' = way (x1 - x0 - dt v0) + now a0 + before a_-1,   x'' = smooth_now a0 + smooth_before a_-1
/// a0 is kept of the step before, and a_-1 of the one before that.
///
/// A method whose stage is not the step's middle takes (a1 - a0)/(t_a1 - t_a0), where the true motion has a0 and a1 at
/// t_a0 and t_a1.  A centred method keeps means.  There it is the change of the mean over two steps.  Motion that is
/// too fast for the step alternates in v from step to step, whatever the steps' lengths are.  So (v1 - v_-1)/(t1 -
/// t_-1) has nothing of it, while a difference of two steps' means has, where the steps differ in length.
struct JerkWeights {
  double way, now, before;            ///< [1/s^3], [1/s], [1/s]
  double smooth_now, smooth_before;   ///< [1]

  /// @param has_before  a_-1 is known
  JerkWeights(const AlphaStep& step, const KeptSteps& kept, bool has_before);
};

/// Of a node, of an attitude's unknowns, or of turning.  `way` is x1 - x0 - dt v0.
template <class Vector>
struct Curve {
  Vector v, a, jerk;

  Curve(const Vector& of_v, const Vector& of_a, const Vector& of_jerk) : v(of_v), a(of_a), jerk(of_jerk) {}
  Curve(const JerkWeights& by, const Vector& way, const Vector& start_v, const Vector& now, const Vector& before)
      : v(start_v),
        a(by.smooth_now * now + by.smooth_before * before),
        jerk(by.way * way + by.now * now + by.before * before) {}
};

}   // namespace cablenet::solve
