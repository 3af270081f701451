#include "cablenet/solve/newton_progress.hpp"

#include <cmath>

namespace cablenet::solve {
namespace {

/// Two residuals are taken for the same that differ by this part.
constexpr double same = 0.1;

/// A residual falls that is this part of the one before.  Half a correction halves it.
constexpr double falling = 0.7;

}   // namespace

void NewtonProgress::note(int iteration, double norm, double noise) {
  iteration_ = iteration;
  falls_ = iteration > 0 && norm < falling * before_[0] ? falls_ + 1 : 0;
  is_best_ = iteration == 0 || norm < falling * best_;
  if (is_best_) best_ = norm;
  if (is_best_ || falls_ >= 2) gained_at_ = iteration;
  returns_ = iteration >= 2 && norm > noise && std::abs(norm - before_[1]) < same * norm;
  cycles_ = iteration > 0 && (cycles_ || returns_);
  before_ = {norm, before_[0]};
}

}   // namespace cablenet::solve
