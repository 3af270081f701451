#pragma once
#include <petscvec.h>

#include <functional>

/// What a run tells those who watch it.
namespace cablenet::solve {

/// An instant of a run: handed to observers.
struct Instant {
  double t;   ///< [s]
  long step;
  Vec x;   ///< positions of the free nodes [m]
  Vec v;   ///< [m/s]
  Vec a;   ///< over the last step, (v1 - v0)/dt where the scheme's own alternates; at the start: exact [m/s^2]
};

struct Counts {
  long steps = 0;
  long rejected = 0;
  long newton = 0;
  long linear = 0;
};

enum class Verdict {
  finished,   ///< the scene's end was reached
  stopped,    ///< by -ts_max_steps or -ts_max_time
  failed      ///< Newton failed down to the smallest step
};

/// Where a step failed: numbers in network::Network, -1 for what it is not.
struct FailedPart {
  int element = -1;
  int body = -1;
  bool left_domain = false;   ///< the body, by an attitude that its description or the step cannot follow
};

struct Observers {
  /// At the start, at every output time, and at the last good state.  Collective.
  std::function<void(const Instant&)> output;
  /// After every step.  Collective.
  std::function<void(double t, double dt, const Counts&)> step;
};

}   // namespace cablenet::solve
