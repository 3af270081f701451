#include <algorithm>
#include <limits>

#include "alpha_parameters.hpp"
#include "cablenet/solve/dynamics.hpp"

/// What TSALPHA2 and its SNES call back.
namespace cablenet::solve {
namespace {

using petsc::check;

/// TSALPHA2's estimate of the first acceleration doubled it before PETSc 3.22.
constexpr double start_factor = PETSC_VERSION_LT(3, 22, 0) ? 0.5 : 1.0;

}   // namespace

bool Dynamics::in_start_phase() const {
  const AlphaParameters p = alpha_parameters(stepper_);
  return p.alpha_m == 1 && p.alpha_f == 1 && p.gamma == 1 && p.beta == 0.5;
}

system::Stage Dynamics::stage() const {
  PetscReal dt = 0;
  check(TSGetTimeStep(stepper_, &dt));
  return {schedule_.time(), dt, alpha_parameters(stepper_).alpha_f};
}

double Dynamics::rounding() const {
  const AlphaParameters p = alpha_parameters(stepper_);
  const double dt = stage().dt;
  return scales_.rounding(furthest_, p.alpha_m / (p.alpha_f * p.beta * dt * dt)) / p.alpha_f;
}

/// A retry searches the line as well; the next step is cheap again.
void Dynamics::choose_line_search(bool retry) {
  if (user_line_search_) return;
  SNES snes = nullptr;
  SNESLineSearch search = nullptr;
  check(TSGetSNES(stepper_, &snes));
  check(SNESGetLineSearch(snes, &search));
  check(SNESLineSearchSetType(search, retry ? SNESLINESEARCHBT : SNESLINESEARCHBASIC));
}

PetscErrorCode Dynamics::residual(TS, PetscReal, Vec x, Vec v, Vec a, Vec r, void* self) noexcept {
  PetscFunctionBeginUser;
  auto& run = *static_cast<Dynamics*>(self);
  if (run.in_start_phase()) {
    PetscCall(VecWAXPY(r, -start_factor, run.start_acceleration_, a));
    PetscFunctionReturn(petsc::success);
  }
  if (!run.assembler_.residual(run.stage(), x, v, a, r)) {
    run.outside_domain_ = run.assembler_.coincident_element();
    // PETSc's own flag for this stays on one rank, and its line searches then leave the others waiting; a norm does
    // not.
    PetscInt count = 0;
    PetscScalar* values = nullptr;
    PetscCall(VecGetLocalSize(r, &count));
    PetscCall(VecGetArrayWrite(r, &values));
    std::fill_n(values, count, std::numeric_limits<double>::infinity());
    PetscCall(VecRestoreArrayWrite(r, &values));
  }
  PetscFunctionReturn(petsc::success);
}

PetscErrorCode Dynamics::jacobian(TS, PetscReal, Vec, Vec, Vec, PetscReal shift_v, PetscReal shift_a, Mat J, Mat P,
                                  void* self) noexcept {
  PetscFunctionBeginUser;
  auto& run = *static_cast<Dynamics*>(self);
  if (run.in_start_phase())
    run.assembler_.scaled_identity(shift_a, P);
  else
    run.assembler_.jacobian(run.stage(), shift_v, shift_a, P);
  if (J != P) {
    PetscCall(MatAssemblyBegin(J, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(J, MAT_FINAL_ASSEMBLY));
  }
  PetscFunctionReturn(petsc::success);
}

/// x + dt v + dt^2/2 a.
PetscErrorCode Dynamics::predict(SNES, Vec x, void* self) noexcept {
  PetscFunctionBeginUser;
  auto& run = *static_cast<Dynamics*>(self);
  if (run.in_start_phase()) PetscFunctionReturn(petsc::success);
  const PetscReal dt = run.stage().dt;
  PetscCall(VecCopy(run.x0_, x));
  PetscCall(VecAXPBYPCZ(x, dt, dt * dt / 2, 1, run.v0_, run.a_));
  PetscFunctionReturn(petsc::success);
}

/// Newton's error falls quadratically, f1 = c f0^2, so c tells how much of a residual that is down to rounding is still
/// error.
bool Dynamics::is_at_rounding(PetscInt iteration, double norm) {
  const double noise = rounding();
  // A retry's step may be so short that the first guess is as good as rounding allows.
  const bool retry = attempts_ > 1;
  if (iteration == 0) return retry && norm <= 8 * noise;
  const double error = curvature_ * previous_norm_ * previous_norm_;
  if (norm > noise) curvature_ = norm / (previous_norm_ * previous_norm_);
  if (norm <= 0.5 * noise && error <= 0.01 * noise) return true;
  // The careful line search of a retry cannot go below rounding at all, and would call that a failure.
  const bool stuck = norm > 0.25 * previous_norm_;
  return (stuck || retry) && norm <= 8 * noise;
}

/// PETSc's default test, and the one above: a relative test is of no use with a good first guess.
PetscErrorCode Dynamics::converged(SNES snes, PetscInt iteration, PetscReal xnorm, PetscReal snorm, PetscReal fnorm,
                                   SNESConvergedReason* reason, void* self) noexcept {
  PetscFunctionBeginUser;
  auto& run = *static_cast<Dynamics*>(self);
  PetscCall(SNESConvergedDefault(snes, iteration, xnorm, snorm, fnorm, reason, nullptr));
  const bool linear_and_solved = run.in_start_phase() && iteration >= 1;
  const bool settled = !run.in_start_phase() && run.is_at_rounding(iteration, fnorm);
  if (*reason == SNES_CONVERGED_ITERATING && (linear_and_solved || settled)) *reason = SNES_CONVERGED_FNORM_ABS;
  run.previous_norm_ = fnorm;
  PetscFunctionReturn(petsc::success);
}

PetscErrorCode Dynamics::before_stage(TS ts, PetscReal) noexcept {
  PetscFunctionBeginUser;
  Dynamics* run = nullptr;
  PetscCall(TSGetApplicationContext(ts, &run));
  if (!run->in_start_phase() && run->attempts_++ == 1) run->choose_line_search(true);
  PetscFunctionReturn(petsc::success);
}

}   // namespace cablenet::solve
