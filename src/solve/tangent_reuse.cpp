#include "cablenet/solve/tangent_reuse.hpp"

#include <cmath>
#include <utility>

#include "cablenet/petsc/handle.hpp"
#include "cablenet/petsc/queries.hpp"

namespace cablenet::solve {
namespace {

using petsc::check;

/// A tangent is kept if its first correction brings the residual down to this, and so did the one before it or all of
/// the last solve: Newton is then near its solution,
constexpr double good = 0.02;

/// and for as long as further ones bring it down to this.
constexpr double worth = 0.2;

/// Iterations that a solve by kept tangents may take.
constexpr int patience = 10;

/// Steps that differ by rounding share a tangent.
constexpr double same_key = 1e-6;

/// PETSc's word for: compute it at the next chance, then never again.
constexpr PetscInt once = -2;

}   // namespace

TangentReuse::TangentReuse(SNES snes, bool worthwhile) : snes_(snes) {
  is_active_ =
      worthwhile && !petsc::has_option("-snes_lag_jacobian") && !petsc::has_option("-snes_lag_jacobian_persists");
  PetscInt lag = 1;
  check(SNESGetLagJacobian(snes_, &lag));
  computes_always_ = lag == 1 && !is_active_;
  if (!is_active_) return;
  refresh();
}

void TangentReuse::refresh() { check(SNESSetLagJacobian(snes_, once)); }

void TangentReuse::begin_solve(double key, bool careful) {
  const bool same = std::abs(key - key_) <= same_key * key_ && !careful;
  is_trusted_ = std::exchange(new_ones_served_, true) && same;
  const bool carries_over = std::exchange(kept_ones_served_, true) && is_trusted_;
  is_careful_ = careful;
  key_ = key;
  good_in_row_ = 0;
  if (is_active_ && !carries_over) refresh();
}

void TangentReuse::note_correction(int iteration, double contraction) {
  const bool kept = !std::exchange(is_new_, false);
  const bool served = contraction <= (kept ? worth : good) && iteration < patience && !is_careful_;
  bool& all = kept ? kept_ones_served_ : new_ones_served_;
  all = all && served;
  good_in_row_ = served ? good_in_row_ + 1 : 0;
  const bool keep = served && (kept || is_trusted_ || good_in_row_ >= 2);
  if (is_active_ && !keep) refresh();
}

}   // namespace cablenet::solve
