#include "cablenet/solve/newton_convergence.hpp"

namespace cablenet::solve {

/// A residual is the error that is left, and rounding.  With a new tangent the error falls quadratically, f1 = c f0^2.
/// With a kept tangent it falls linearly, f1 = rate f0.  Earlier corrections show c and the rate.  These predict the
/// error that is left where rounding hides it.
bool NewtonConvergence::is_at_rounding(int iteration, double norm, double noise, bool searches, bool same_tangent) {
  const double previous = previous_norm_;
  previous_norm_ = norm;
  contraction_ = iteration == 0 || previous == 0 ? 0 : norm / previous;
  if (iteration == 0) return searches && norm <= most_of_noise * noise;
  const double error = same_tangent ? rate_ * previous : curvature_ * previous * previous;
  if (norm > noise && same_tangent) rate_ = contraction_;
  if (!same_tangent) note_curvature(norm, previous, noise);
  if (norm <= 0.5 * noise && error <= 0.01 * noise) return true;
  // The careful line search of a retry cannot go below rounding at all, and would call that a failure.
  const bool stuck = norm > 0.25 * previous;
  return (stuck || searches) && norm <= (same_tangent ? 1 : most_of_noise) * noise;
}

/// A residual below rounding still bounds the error that a correction left.  The last such bound serves until a
/// curvature is seen.
void NewtonConvergence::note_curvature(double norm, double previous, double noise) {
  if (previous <= noise || (norm <= noise && has_seen_curvature_)) return;
  curvature_ = norm / (previous * previous);
  has_seen_curvature_ = norm > noise;
}

void NewtonConvergence::archive(Archive& archive) {
  archive.item("newton.previous_norm", previous_norm_);
  archive.item("newton.rate", rate_);
  archive.item("newton.curvature", curvature_);
  archive.item("newton.has_seen_curvature", has_seen_curvature_);
}

}   // namespace cablenet::solve
