#include "cablenet/solve/newton_convergence.hpp"

#include <algorithm>

namespace cablenet::solve {
namespace {

/// An error of this part of the rounding is none.  Its work on the motion adds up over steps, and rounding's does not.
constexpr double none = 0.01;

/// What is known of the hidden error is worth less after each solve.
constexpr double forgotten = 1.005;

}   // namespace

/// It goes with the guess's square, but it does not become less with a smaller one: stiff parts of a guess's error hide
/// the others, which the error goes with as well.
double NewtonConvergence::hidden_error(double previous, double correction) const {
  const double growth = std::max({1.0, previous / hidden_.guess, correction / hidden_.correction});
  return hidden_.error * growth * growth;
}

/// A residual is the error that is left, and rounding.  With a new tangent the error falls quadratically, f1 = c f0^2.
/// With a kept tangent it falls linearly, f1 = rate f0.  Earlier corrections show c and the rate.  These predict the
/// error that is left where rounding hides it.
bool NewtonConvergence::is_at_rounding(int iteration, double norm, double correction, double noise, bool searches,
                                       bool same_tangent) {
  const double previous = previous_norm_;
  previous_norm_ = norm;
  contraction_ = iteration == 0 || previous == 0 ? 0 : norm / previous;
  if (iteration == 0) {
    was_in_doubt_ = false;
    return searches && norm <= most_of_noise * noise;
  }
  const double error = same_tangent ? rate_ * previous : curvature_ * previous * previous;
  if (norm > noise && same_tangent) rate_ = contraction_;
  if (!same_tangent && farther_ == 1) note_curvature(norm, previous, noise);
  if (norm <= 0.5 * noise && error <= none * noise) return true;
  if (iteration == 1 && !same_tangent && !searches && ends_at_once(norm, previous, correction, noise)) return true;
  // The careful line search of a retry cannot go below rounding at all, and would call that a failure.
  const bool stuck = norm > 0.25 * previous;
  return (stuck || searches) && norm <= (same_tangent ? 1 : most_of_noise) * noise;
}

/// One correction is enough where the solve with a moved guess has shown that nothing is hidden.
bool NewtonConvergence::ends_at_once(double norm, double previous, double correction, double noise) {
  was_in_doubt_ = norm <= 0.5 * noise;
  if (farther_ > 1) {
    hidden_ = {norm / (farther_ * farther_), previous / farther_, correction / farther_};
    return false;
  }
  hidden_.error *= forgotten;
  if (!was_in_doubt_ || hidden_error(previous, correction) > none * noise) return false;
  was_in_doubt_ = false;
  return true;
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
  archive.item("newton.hidden_error", hidden_.error);
  archive.item("newton.hidden_guess", hidden_.guess);
  archive.item("newton.hidden_correction", hidden_.correction);
  archive.item("newton.rate", rate_);
  archive.item("newton.curvature", curvature_);
  archive.item("newton.has_seen_curvature", has_seen_curvature_);
}

}   // namespace cablenet::solve
