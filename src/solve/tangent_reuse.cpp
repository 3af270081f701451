#include "cablenet/solve/tangent_reuse.hpp"

#include <cmath>
#include <utility>

namespace cablenet::solve {
namespace {

/// A correction by a new tangent serves if it brings the residual down to this part: Newton's method is then near its
/// solution.  A new tangent is kept after two such corrections in a row, or after one if the last solve had only such.
constexpr double good = 0.02;

/// A correction by a kept tangent serves if it brings the residual down to this part.
constexpr double worth = 0.2;

/// Iterations that a solve by kept tangents may take.
constexpr int patience = 10;

/// Steps that differ by rounding share a tangent.
constexpr double same_key = 1e-6;

}   // namespace

void TangentReuse::begin_solve(double key, bool careful) {
  const bool same = std::abs(key - key_) <= same_key * key_ && !careful;
  is_trusted_ = std::exchange(new_ones_served_, true) && same;
  const bool carries_over = std::exchange(kept_ones_served_, true) && is_trusted_;
  is_careful_ = careful;
  key_ = key;
  good_in_row_ = 0;
  if (!carries_over) wants_new_ = true;
}

void TangentReuse::note_computed() {
  is_new_ = true;
  wants_new_ = !keeps_;
}

void TangentReuse::note_correction(int iteration, double contraction) {
  const bool kept = !std::exchange(is_new_, false);
  const bool served = contraction <= (kept ? worth : good) && iteration < patience && !is_careful_;
  bool& all = kept ? kept_ones_served_ : new_ones_served_;
  all = all && served;
  good_in_row_ = served ? good_in_row_ + 1 : 0;
  const bool keep = served && (kept || is_trusted_ || good_in_row_ >= 2);
  if (!keep) wants_new_ = true;
}

}   // namespace cablenet::solve
