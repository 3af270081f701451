#include <algorithm>
#include <limits>

#include "cablenet/petsc/object_state.hpp"
#include "cablenet/solve/dynamics.hpp"

/// What TSALPHA2 and its SNES call back.
namespace cablenet::solve {
namespace {

using petsc::check;

/// TSALPHA2's estimate of the first acceleration doubled it before PETSc 3.22.
constexpr double start_factor = PETSC_VERSION_LT(3, 22, 0) ? 0.5 : 1.0;

}   // namespace

AlphaStep read_alpha_step(TS ts) {
  PetscReal alpha_m = 0, alpha_f = 0, gamma = 0, beta = 0, dt = 0;
  check(TSAlpha2GetParams(ts, &alpha_m, &alpha_f, &gamma, &beta));
  check(TSGetTimeStep(ts, &dt));
  return {alpha_m, alpha_f, gamma, beta, dt};
}

system::TangentRequest Dynamics::tangent_request() { return {tangent_, {1, alpha_.shift_v(), alpha_.shift_a()}}; }

/// A retry searches the line as well; the next step is cheap again.
void Dynamics::choose_line_search(bool retry) {
  if (user_line_search_) return;
  SNESLineSearch search = nullptr;
  check(SNESGetLineSearch(snes_, &search));
  check(SNESLineSearchSetType(search, retry ? SNESLINESEARCHBT : SNESLINESEARCHBASIC));
}

PetscErrorCode Dynamics::residual(TS, PetscReal, Vec x, Vec v, Vec a, Vec r, void* self) noexcept {
  PetscFunctionBeginUser;
  auto& run = *static_cast<Dynamics*>(self);
  if (run.alpha_.is_start()) {
    PetscCall(VecWAXPY(r, -start_factor, run.start_acceleration_, a));
    PetscFunctionReturn(petsc::success);
  }
  // Newton asks for the tangent after each residual but the last: both in one pass where another is expected.
  const bool wants_tangent = run.combines_ && run.attempts_ <= 1 && run.evaluations_++ < run.expected_newton_;
  const system::TangentRequest request = run.tangent_request();
  if (wants_tangent) run.tangent_at_ = petsc::state_of(x);
  if (!run.assembler_.residual(run.stage(), x, v, a, r, wants_tangent ? &request : nullptr)) {
    run.outside_domain_ = run.assembler_.coincident_element();
    run.outside_body_ = run.assembler_.outside_body();
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

PetscErrorCode Dynamics::jacobian(TS, PetscReal, Vec x, Vec v, Vec a, PetscReal shift_v, PetscReal shift_a, Mat J,
                                  Mat P, void* self) noexcept {
  PetscFunctionBeginUser;
  auto& run = *static_cast<Dynamics*>(self);
  run.reuse_.note_computed();
  if (run.alpha_.is_start()) {
    run.tangent_.set_identity(shift_a);
  } else {
    if (petsc::state_of(x) != run.tangent_at_)
      run.assembler_.tangent(run.stage(), x, v, a, {run.tangent_, {1, shift_v, shift_a}});
    run.tangent_.publish();
  }
  run.tangent_at_ = {};
  if (J != P) {
    PetscCall(MatAssemblyBegin(J, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(J, MAT_FINAL_ASSEMBLY));
  }
  PetscFunctionReturn(petsc::success);
}

/// x + dt v + dt^2/2 a; the stepper's own vectors stay at the step's start until it is accepted.
PetscErrorCode Dynamics::predict(SNES, Vec x, void* self) noexcept {
  PetscFunctionBeginUser;
  auto& run = *static_cast<Dynamics*>(self);
  run.alpha_ = read_alpha_step(run.stepper_);
  run.evaluations_ = 0;
  run.tangent_at_ = {};
  const double dt = run.alpha_.dt;
  run.reuse_.begin_solve(run.alpha_.is_start() ? -dt : dt, run.attempts_ > 1);
  if (run.alpha_.is_start()) PetscFunctionReturn(petsc::success);
  PetscCall(VecWAXPY(x, dt, run.v_, run.x_));
  PetscCall(VecAXPY(x, dt * dt / 2, run.a_));
  PetscFunctionReturn(petsc::success);
}

bool Dynamics::is_at_rounding(PetscInt iteration, double norm) {
  const double noise = scales_.rounding(furthest_, alpha_.shift_a()) / alpha_.alpha_f;
  // A careful search cannot go below rounding, and would call that a failure.
  const bool is_retry = attempts_ > 1 || (user_line_search_ && iteration > 0);
  const bool settled =
      convergence_.is_at_rounding(static_cast<int>(iteration), norm, noise, is_retry, reuse_.was_kept());
  if (iteration > 0) reuse_.note_correction(static_cast<int>(iteration), convergence_.contraction());
  return settled;
}

/// PETSc's default test, and the one above: a relative test is of no use with a good first guess.
PetscErrorCode Dynamics::converged(SNES snes, PetscInt iteration, PetscReal xnorm, PetscReal snorm, PetscReal fnorm,
                                   SNESConvergedReason* reason, void* self) noexcept {
  PetscFunctionBeginUser;
  auto& run = *static_cast<Dynamics*>(self);
  PetscCall(SNESConvergedDefault(snes, iteration, xnorm, snorm, fnorm, reason, nullptr));
  const bool linear_and_solved = run.alpha_.is_start() && iteration >= 1;
  const bool settled = !run.alpha_.is_start() && run.is_at_rounding(iteration, fnorm);
  if (*reason == SNES_CONVERGED_ITERATING && (linear_and_solved || settled)) *reason = SNES_CONVERGED_FNORM_ABS;
  PetscFunctionReturn(petsc::success);
}

PetscErrorCode Dynamics::before_stage(TS ts, PetscReal) noexcept {
  PetscFunctionBeginUser;
  Dynamics* run = nullptr;
  PetscCall(TSGetApplicationContext(ts, &run));
  run->outside_domain_ = run->outside_body_ = -1;
  if (run->control_) run->control_->begin_attempt();
  if (!read_alpha_step(ts).is_start() && run->attempts_++ == 1) run->choose_line_search(true);
  PetscFunctionReturn(petsc::success);
}

/// PETSc asks after each of its stages that Newton's method solved.
PetscErrorCode Dynamics::check_error(TSAdapt, TS ts, PetscReal, Vec, PetscBool* accept) noexcept {
  PetscFunctionBeginUser;
  Dynamics* run = nullptr;
  PetscCall(TSGetApplicationContext(ts, &run));
  if (run->alpha_.is_start()) PetscFunctionReturn(petsc::success);
  Vec end = nullptr;
  PetscCall(SNESGetSolution(run->snes_, &end));
  const StepStart start{run->x_, run->v_, run->a_};
  if (run->control_->accepts(run->alpha_, run->assembler_.network(), start, end)) PetscFunctionReturn(petsc::success);
  *accept = PETSC_FALSE;
  // Newton's method did well, so the next attempt need not be careful.
  if (run->attempts_ == 1) run->attempts_ = 0;
  PetscFunctionReturn(petsc::success);
}

}   // namespace cablenet::solve
