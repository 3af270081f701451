#include "cablenet/solve/tangent_reuse.hpp"

#include <cmath>
#include <utility>

#include "cablenet/petsc/handle.hpp"

namespace cablenet::solve {
namespace {

using petsc::check;

/// A residual that falls less than this by an old tangent pays for a new one.
constexpr double slow = 0.3;

/// Steps that differ by rounding share a tangent.
constexpr double same_key = 1e-6;

/// PETSc's word for: compute it at the next chance, then never again.
constexpr PetscInt once = -2;

}   // namespace

TangentReuse::TangentReuse(SNES snes, bool worthwhile) : snes_(snes) {
  PetscBool chosen = PETSC_FALSE;
  check(PetscOptionsHasName(nullptr, nullptr, "-snes_lag_jacobian", &chosen));
  is_active_ = worthwhile && chosen == PETSC_FALSE;
  PetscInt lag = 1;
  check(SNESGetLagJacobian(snes_, &lag));
  computes_always_ = lag == 1 && !is_active_;
  if (!is_active_) return;
  check(SNESSetLagJacobianPersists(snes_, PETSC_TRUE));
  refresh();
}

void TangentReuse::refresh() { check(SNESSetLagJacobian(snes_, once)); }

void TangentReuse::begin_solve(double key) {
  if (!is_active_ || std::abs(key - key_) <= same_key * key_) return;
  key_ = key;
  refresh();
}

void TangentReuse::note_correction(int iteration, double contraction) {
  was_kept_ = !std::exchange(is_new_, false);
  if (is_active_ && iteration > 1 && contraction > slow) refresh();
}

}   // namespace cablenet::solve
