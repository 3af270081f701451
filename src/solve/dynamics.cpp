#include "cablenet/solve/dynamics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cablenet/base/errors.hpp"
#include "cablenet/petsc/queries.hpp"
#include "cablenet/solve/defaults.hpp"
#include "failed_part.hpp"

namespace cablenet::solve {
namespace {

using petsc::check;
using petsc::has_option;

/// Over the step that was asked for: where shrinking it ends.
constexpr double smallest_step = 1e-10;

/// Halvings that bring an adaptive step below that.
constexpr PetscInt most_rejections = 40;

/// Newton's tolerance over the forces at the start.
constexpr double relative_force_tolerance = 1e-12;

/// How often the largest coordinate, which rounding depends on, is looked up.
constexpr long steps_between_norms = 64;

}   // namespace

Dynamics::Dynamics(system::Assembler& assembler, const scene::Time& time, double output_interval, const char* prefix)
    : assembler_(assembler),
      time_(time),
      schedule_(time.start, time.end, time.step, output_interval),
      scales_(assembler.force_scales()),
      tangent_(assembler.make_tangent()),
      user_line_search_(has_option("-snes_linesearch_type") || has_option("-snes_type")) {
  for (auto* vector : {&x_, &v_, &a_, &x0_, &v0_, &start_acceleration_}) *vector = assembler_.make_vector();
  assembler_.fill_initial(x_, v_);
  create_stepper(prefix);
  configure_solvers();
  read_limits();
}

void Dynamics::create_stepper(const char* prefix) {
  check(TSCreate(assembler_.communicator(), stepper_.out()));
  check(TSSetOptionsPrefix(stepper_, prefix));
  check(TSSetType(stepper_, TSALPHA2));
  check(TSAlpha2SetRadius(stepper_, time_.spectral_radius));
  check(TSSetApplicationContext(stepper_, this));
  check(TSSetI2Function(stepper_, nullptr, residual, this));
  check(TSSetI2Jacobian(stepper_, tangent_.matrix(), tangent_.matrix(), jacobian, this));
  check(TSSetPreStage(stepper_, before_stage));
  check(TS2SetSolution(stepper_, x_, v_));
  check(TSSetTime(stepper_, time_.start));
  check(TSSetTimeStep(stepper_, time_.step));
  check(TSSetMaxTime(stepper_, time_.end));
  check(TSSetMaxSteps(stepper_, std::numeric_limits<PetscInt>::max()));
  check(TSSetExactFinalTime(stepper_, TS_EXACTFINALTIME_STEPOVER));
  check(TSSetMaxSNESFailures(stepper_, petsc::unlimited));
  check(TSSetErrorIfStepFails(stepper_, PETSC_FALSE));
  if (time_.tolerance) check(TSSetMaxStepRejections(stepper_, most_rejections));
  TSAdapt adapt = nullptr;
  check(TSGetAdapt(stepper_, &adapt));
  check(TSAdaptSetType(adapt, TSADAPTNONE));
}

void Dynamics::configure_solvers() {
  check(TSGetSNES(stepper_, &snes_));
  check(SNESGetKSP(snes_, &ksp_));
  configure_newton(snes_, relative_force_tolerance * scales_.load);
  check(SNESSetConvergenceTest(snes_, converged, this, nullptr));
  check(SNESSetComputeInitialGuess(snes_, predict, this));
  linear_ = configure_linear_solver(ksp_, assembler_.network(), tangent_.matrix());
  check(TSSetFromOptions(stepper_));
  reuse_ = TangentReuse(snes_, linear_.factors_are_dear);
  combines_ = reuse_.computes_always() && follows_residuals_by_tangents();
}

/// Newton with a basic line search does; other methods evaluate residuals elsewhere while they use the tangent.
bool Dynamics::follows_residuals_by_tangents() const {
  SNESLineSearch search = nullptr;
  PetscBool newton = PETSC_FALSE, basic = PETSC_FALSE;
  check(SNESGetLineSearch(snes_, &search));
  check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(snes_), SNESNEWTONLS, &newton));
  check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(search), SNESLINESEARCHBASIC, &basic));
  return newton && basic && !has_option("-snes_mf") && !has_option("-snes_mf_operator");
}

/// What the user's options made of the scene's times.
void Dynamics::read_limits() {
  TSAdapt adapt = nullptr;
  PetscBool fixed_steps = PETSC_TRUE;
  check(TSGetAdapt(stepper_, &adapt));
  check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(adapt), TSADAPTNONE, &fixed_steps));
  user_adapts_ = fixed_steps == PETSC_FALSE;
  keeps_mean_acceleration_ = read_alpha_step(stepper_).alternates();
  PetscReal end = time_.end;
  check(TSGetTimeStep(stepper_, &time_.step));
  check(TSGetMaxTime(stepper_, &end));
  const double interval = schedule_.interval();
  schedule_ = Schedule(time_.start, std::min<double>(end, time_.end), time_.step, interval);
  if (!time_.tolerance || has_option("-ts_adapt_type")) return;
  const double span = time_.end - time_.start, longest = interval > 0 ? std::min(interval, span) : span;
  control_.emplace(adapt, *time_.tolerance, time_.step, longest, smallest_step * time_.step);
  check(TSAdaptSetCheckStage(adapt, check_error));
}

Instant Dynamics::instant() const { return {schedule_.time(), counts_.steps, x_, v_, a_}; }

/// M a0 = f(t0, x0, v0).
void Dynamics::solve_initial_acceleration() {
  assembler_.force(time_.start, x_, v_, x0_);
  assembler_.mass_matrix(time_.start, x_, v_, tangent_);
  tangent_.publish();
  check(KSPSetOperators(ksp_, tangent_.matrix(), tangent_.matrix()));
  check(KSPSolve(ksp_, x0_, start_acceleration_));
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  check(KSPGetConvergedReason(ksp_, &reason));
  if (reason < 0)
    throw SolverError(
        fmt::format("the first acceleration could not be solved for: the linear solver stopped with {}; "
                    "try it without -ksp_type and -pc_type options",
                    KSPConvergedReasons[reason]));
  check(VecCopy(start_acceleration_, a_));
}

Verdict Dynamics::run(const Observers& observers) {
  solve_initial_acceleration();
  observers.output(instant());
  PetscInt most_steps = 0;
  check(TSGetMaxSteps(stepper_, &most_steps));
  while (!schedule_.at_end()) {
    if (counts_.steps >= most_steps) {
      if (!schedule_.at_output()) observers.output(instant());
      return Verdict::stopped;
    }
    if (!step(schedule_.next_step())) {
      if (!schedule_.at_output()) observers.output(instant());
      return Verdict::failed;
    }
    observers.step(schedule_.time(), last_step_, counts_);
    const bool exhausted = last_step_ < smallest_step * time_.step;
    outside_body_ = assembler_.nearly_singular_body(x_);
    if (schedule_.at_output() || exhausted || outside_body_ >= 0) observers.output(instant());
    if (outside_body_ >= 0) return Verdict::failed;
    if (exhausted) {
      if (control_) failure_ = control_->refusal(last_step_);
      if (failure_.empty())
        failure_ = fmt::format("Newton's method succeeds only with steps as short as {:.3g} s", last_step_);
      return Verdict::failed;
    }
  }
  return schedule_.time() < time_.end ? Verdict::stopped : Verdict::finished;
}

bool Dynamics::step(double dt) {
  const double t = schedule_.time();
  if (!keeps_mean_acceleration_) check(VecCopy(x_, x0_));
  check(VecCopy(v_, v0_));
  assembler_.begin_step(t, x_, v_);
  if (schedule_.at_output() || counts_.steps % steps_between_norms == 0) check(VecNorm(x_, NORM_INFINITY, &furthest_));
  // Sines and cosines of small angles are rounded as those of large ones.
  if (!assembler_.network().blocks.uniform()) furthest_ = std::max(furthest_, 1.0);
  check(TSSetTime(stepper_, t));
  check(TSSetTimeStep(stepper_, dt));
  attempts_ = 0;
  check(TSStep(stepper_));
  TSConvergedReason reason = TS_CONVERGED_ITERATING;
  check(TSGetConvergedReason(stepper_, &reason));
  PetscInt rejected = 0, newton = 0, linear = 0;
  check(TSGetStepRejections(stepper_, &rejected));
  check(TSGetSNESIterations(stepper_, &newton));
  check(TSGetKSPIterations(stepper_, &linear));
  const bool retried = rejected > counts_.rejected;
  expected_newton_ = static_cast<int>(newton - counts_.newton);
  counts_ = {counts_.steps, rejected, newton, linear};
  choose_line_search(false);
  if (reason < 0) {
    explain_failure();
    return false;
  }
  PetscReal reached = 0;
  check(TSGetTime(stepper_, &reached));
  accept(t, retried ? reached - t : dt, retried);
  return true;
}

void Dynamics::accept(double t, double taken, bool retried) {
  last_step_ = taken;
  ++counts_.steps;
  assembler_.end_step({t, taken, alpha_.alpha_f}, x_, v_);
  update_acceleration(taken);
  PetscReal next = 0;
  check(TSGetTimeStep(stepper_, &next));
  schedule_.advance(taken, retried);
  if (control_) control_->advance(retried);
  if (control_ || user_adapts_) schedule_.set_limit(control_ ? control_->limit() : next);
  check(TSMonitor(stepper_, static_cast<PetscInt>(counts_.steps), schedule_.time(), x_));
}

/// TSALPHA2 keeps its acceleration to itself, so it is computed again by the same formula.  At spectral radius 1 it
/// alternates about the truth and the step's mean is reported instead.
void Dynamics::update_acceleration(double dt) {
  if (keeps_mean_acceleration_) {
    check(VecAXPBYPCZ(a_, 1 / dt, -1 / dt, 0, v_, v0_));
    return;
  }
  const double beta = alpha_.beta, by_dt2 = 1 / (beta * dt * dt);
  check(VecAXPBYPCZ(a_, by_dt2, -by_dt2, -(1 - 2 * beta) / (2 * beta), x_, x0_));
  check(VecAXPY(a_, -1 / (beta * dt), v0_));
}

void Dynamics::explain_failure() {
  SNESConvergedReason reason = SNES_CONVERGED_ITERATING;
  PetscReal dt = 0;
  check(SNESGetConvergedReason(snes_, &reason));
  check(TSGetTimeStep(stepper_, &dt));
  if (reason > 0 && control_) {
    failure_ = control_->refusal(alpha_.dt);
    return;
  }
  failure_ = fmt::format("Newton's method failed ({}) with steps down to {:.3g} s", SNESConvergedReasons[reason], dt);
  if (!linear_.elimination) return;
  const PivotReport pivots = linear_.elimination->pivots();
  failed_node_ = pivots.singular_node;
  if (failed_node_.exists()) failure_ += "; the tangent is singular there";
  if (pivots.negative > 0) failure_ += fmt::format("; the tangent has {} negative pivots", pivots.negative);
}

FailedPart Dynamics::failed_part() {
  Vec r = nullptr;
  check(SNESGetFunction(snes_, &r, nullptr, nullptr));
  return worst_part(assembler_, r, {failed_node_, outside_domain_, outside_body_});
}

std::string Dynamics::linear_solver() const { return describe(ksp_, linear_); }

}   // namespace cablenet::solve
