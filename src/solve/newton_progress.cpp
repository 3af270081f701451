#include "cablenet/solve/newton_progress.hpp"

#include <algorithm>
#include <cmath>

#include "cablenet/base/index.hpp"

namespace cablenet::solve {
namespace {

/// Two residuals are taken for the same that differ by this part: those with one between them, and others.
constexpr double same = 0.1, exactly_same = 1e-4;

/// A cycle is left behind where the residual is this part of those that returned.
constexpr double left = 1e-2;

/// A residual falls that is this part of the one before.  Half a correction halves it.
constexpr double falling = 0.7;

}   // namespace

void NewtonProgress::note(int iteration, double norm, double noise) {
  iteration_ = iteration;
  falls_ = iteration > 0 && norm < falling * before_[0] ? falls_ + 1 : 0;
  is_best_ = iteration == 0 || norm < falling * best_;
  if (is_best_) best_ = norm;
  if (is_best_ || falls_ >= 2) gained_at_ = iteration;
  returns_ = false;
  for (int back = 2; back <= std::min<int>(iteration, before_.size()); ++back) {
    const double part = back == 2 ? same : exactly_same;
    returns_ = returns_ || (norm > noise && std::abs(norm - before_[at(back - 1)]) < part * norm);
  }
  if (returns_) cycled_at_ = norm;
  cycles_ = iteration > 0 && (returns_ || (cycles_ && norm > left * cycled_at_));
  std::rotate(before_.begin(), before_.end() - 1, before_.end());
  before_[0] = norm;
}

}   // namespace cablenet::solve
