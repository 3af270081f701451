#include "cablenet/solve/newton_progress.hpp"

#include <cmath>

namespace cablenet::solve {
namespace {

/// Two residuals are taken for the same that differ by this part.
constexpr double same = 0.1;

/// A residual that falls to this part of the best one is progress.  Half a correction halves it.
constexpr double progress = 0.7;

}   // namespace

void NewtonProgress::note(int iteration, double norm) {
  iteration_ = iteration;
  if (iteration == 0 || norm < progress * best_) {
    best_ = norm;
    best_at_ = iteration;
  }
  returns_ = iteration >= 2 && std::abs(norm - before_[1]) < same * norm;
  cycles_ = iteration > 0 && (cycles_ || returns_);
  before_ = {norm, before_[0]};
}

}   // namespace cablenet::solve
