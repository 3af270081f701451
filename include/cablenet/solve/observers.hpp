#pragma once
#include <petscvec.h>

#include <functional>

/// What a run through time tells those who watch it.
namespace cablenet::solve {

/// An instant of a run.  The vectors hold the unknowns of the free nodes and bodies.
struct Instant {
  double t;    ///< [s]
  long step;   ///< steps done
  Vec x;       ///< positions [m]
  Vec v;       ///< velocities [m/s]
  /// Accelerations: exact at the start; later those of the scheme, or the mean of the last step where the scheme's own
  /// alternate from step to step (AlphaWeights::is_centred).  [m/s^2]
  Vec a;
};

/// How many there were since the start.
struct Counts {
  long steps = 0;
  long rejected = 0;   ///< attempts at steps
  long newton = 0;     ///< iterations of Newton's method, those of rejected attempts included
  long linear = 0;     ///< iterations of the linear solver, likewise
};

enum class Verdict {
  finished,   ///< the scene's end was reached
  stopped,    ///< by -ts_max_steps or -ts_max_time
  failed      ///< no step was short enough
};

/// Where a step failed: at an element or at a body.  The other one is -1.
struct FailedPart {
  int element = -1;           ///< in Network::elements
  int body = -1;              ///< in Network::bodies
  bool left_domain = false;   ///< the body turned to an attitude that its description or the step cannot follow
};

struct Observers {
  /// At the start, at every output time, and at the last good state.  Collective.
  std::function<void(const Instant&)> output;
  /// After every step.  Collective.
  std::function<void(double t, double dt, const Counts&)> step;
};

}   // namespace cablenet::solve
