#include "cablenet/solve/jerk.hpp"

#include <algorithm>

namespace cablenet::solve {
namespace {

/// A step that is shorter than this part of the one before is estimated by itself.
constexpr double shrunk = 0.75;

}   // namespace

/// A mean belongs to the step's middle.  Otherwise the time follows from the stage: there the method balances forces,
/// so that the true motion has the acceleration (1 - alpha_m) a0 + alpha_m a1.
KeptSteps KeptSteps::after(const AlphaStep& step) const {
  if (step.is_centred()) return {-step.dt / 2, step.dt, last};
  return {(step.alpha_f * step.dt - (1 - step.alpha_m) * time) / step.alpha_m - step.dt, step.dt, last};
}

void KeptSteps::archive(Archive& archive) {
  archive.item("kept_steps.time", time);
  archive.item("kept_steps.last", last);
  archive.item("kept_steps.before", before);
}

/// a1 = (x1 - x0 - dt v0 - (1/2 - beta) dt^2 a0)/(beta dt^2).  Where means are kept, 1/2 takes the place of beta.
JerkWeights::JerkWeights(const AlphaStep& step, const KeptSteps& kept, bool has_before)
    : before(0), smooth_now(1), smooth_before(0) {
  const double dt = step.dt, beta = step.is_centred() ? 0.5 : step.beta;
  if (!has_before) {
    const double between = dt + kept.after(step).time - kept.time;
    way = 1 / (beta * dt * dt * between);
    now = -0.5 / (beta * between);
    return;
  }
  // The start's acceleration is no mean over a step.  It stands alone, at the start.
  smooth_before = kept.before > 0 ? kept.before / (kept.last + kept.before) : 1;
  smooth_now = 1 - smooth_before;
  if (dt < shrunk * kept.last) {
    way = 2 / (dt * dt * dt);
    now = -1 / dt;
    return;
  }
  const double both = dt + kept.last, between = std::min(dt, (dt + (kept.before > 0 ? kept.before : kept.last)) / 2);
  way = 2 / (dt * both * between);
  now = (kept.last / both - smooth_now) / between;
  before = -smooth_before / between;
}

}   // namespace cablenet::solve
