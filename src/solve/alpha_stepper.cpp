#include "cablenet/solve/alpha_stepper.hpp"

#include <algorithm>
#include <limits>

#include "cablenet/petsc/options.hpp"
#include "cablenet/solve/scheme.hpp"
#include "vector_archive.hpp"

namespace cablenet::solve {
namespace {

using petsc::check;

/// Before PETSc 3.22 TSALPHA2's estimate of the first acceleration is twice what it should be.
constexpr double start_factor = PETSC_VERSION_LT(3, 22, 0) ? 0.5 : 1.0;

/// Over which a step's error can count.  Water's drag forgets it, and so does the damping by which a network settles.
/// [s]
double memory_of(const partition::LocalNetwork& network, const scene::Time& time) {
  constexpr double part = 0.1;
  const bool forgets = network.surroundings.fluid || network.held_time;
  return forgets ? 0 : part * (time.end - time.start);
}

/// Where the stage is the step's middle.
bool conserves_bodies(const system::Assembler& assembler) {
  const system::Stage middle{0, 1, 0.5};
  return assembler.rule().conserves(middle, assembler.network().surroundings.fluid.has_value());
}

/// So many attempts are made before a step is shortened.
constexpr int most_of_a_length = 3;

/// So many halvings bring an adaptive step below any that is of use.
constexpr PetscInt most_rejections = 40;

/// PETSc takes -ts_alpha_radius for Chung and Hulbert's weights, whatever the scheme.
void keep_weights(TS stepper, const scene::Time& time, const char* prefix) {
  const auto names = {"-ts_alpha_alpha_m", "-ts_alpha_alpha_f", "-ts_alpha_gamma", "-ts_alpha_beta"};
  const auto is_given = [&](const char* name) { return petsc::has_option(name, prefix); };
  if (!is_given("-ts_alpha_radius") || std::any_of(names.begin(), names.end(), is_given)) return;
  const AlphaWeights weights = weights_of(time);
  check(TSAlpha2SetParams(stepper, weights.alpha_m, weights.alpha_f, weights.gamma, weights.beta));
}

}   // namespace

AlphaStepper::AlphaStepper(const system::Assembler& assembler, StageEquations& equations, const scene::Time& time,
                           long most_steps, const char* prefix)
    : network_(assembler.network()),
      equations_(equations),
      local_error_(memory_of(assembler.network(), time), conserves_bodies(assembler),
                   assembler.rule().axial_dissipation) {
  for (auto* vector : {&x_, &v_, &a_, &x0_, &v0_, &start_acceleration_, &own_a_, &expected_a_})
    *vector = assembler.make_vector();
  assembler.fill_initial(x_, v_);
  local_error_.prepare(network_);
  check(TSCreate(assembler.communicator(), stepper_.out()));
  configure(time, most_steps, prefix);
  check(TSGetSNES(stepper_, &snes_));
  check(SNESSetComputeInitialGuess(snes_, begin_solve, this));
  equations_.configure(snes_);
  check(TSSetFromOptions(stepper_));
  keep_weights(stepper_, time, prefix);
  equations_.adopt_options();
  check(TSAdaptGetScaleSolveFailed(adapt_, &failed_scale_));
  PetscBool fixed = PETSC_TRUE;
  check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(adapt_), TSADAPTNONE, &fixed));
  user_adapts_ = fixed == PETSC_FALSE;
  keeps_mean_acceleration_ = read_step().is_centred();
  keeps_own_acceleration_ = keeps_mean_acceleration_ && read_step().alpha_m != 0.5;
  shows_while_solving_ = petsc::shows_while_solving();
}

void AlphaStepper::configure(const scene::Time& time, long most_steps, const char* prefix) {
  const Mat tangent = equations_.tangent_matrix();
  const AlphaWeights weights = weights_of(time);
  check(TSSetOptionsPrefix(stepper_, prefix));
  check(TSSetType(stepper_, TSALPHA2));
  check(TSAlpha2SetParams(stepper_, weights.alpha_m, weights.alpha_f, weights.gamma, weights.beta));
  check(TSSetApplicationContext(stepper_, this));
  check(TSSetI2Function(stepper_, nullptr, residual, this));
  check(TSSetI2Jacobian(stepper_, tangent, tangent, jacobian, this));
  check(TSSetPreStage(stepper_, begin_stage));
  check(TS2SetSolution(stepper_, x_, v_));
  check(TSSetTime(stepper_, time.start));
  check(TSSetTimeStep(stepper_, time.step));
  check(TSSetMaxTime(stepper_, time.end));
  check(
      TSSetMaxSteps(stepper_, static_cast<PetscInt>(std::min<long>(most_steps, std::numeric_limits<PetscInt>::max()))));
  check(TSSetExactFinalTime(stepper_, TS_EXACTFINALTIME_STEPOVER));
  check(TSSetMaxSNESFailures(stepper_, petsc::unlimited));
  check(TSSetErrorIfStepFails(stepper_, PETSC_FALSE));
  if (time.tolerance) check(TSSetMaxStepRejections(stepper_, most_rejections));
  check(TSGetAdapt(stepper_, &adapt_));
  check(TSAdaptSetType(adapt_, TSADAPTNONE));
}

void AlphaStepper::show_options(MPI_Comm communicator) {
  TimeStepper stepper;
  check(TSCreate(communicator, stepper.out()));
  check(TSSetType(stepper, TSALPHA2));
  check(TSSetFromOptions(stepper));
}

double AlphaStepper::first_step() const {
  PetscReal step = 0;
  check(TSGetTimeStep(stepper_, &step));
  return step;
}

double AlphaStepper::end() const {
  PetscReal end = 0;
  check(TSGetMaxTime(stepper_, &end));
  return end;
}

long AlphaStepper::most_steps() const {
  PetscInt steps = 0;
  check(TSGetMaxSteps(stepper_, &steps));
  return steps;
}

void AlphaStepper::control_errors(std::function<bool(const Error&, double)> accepts, double scale) {
  accepts_ = std::move(accepts);
  refused_scale_ = scale;
  check(TSAdaptSetCheckStage(adapt_, check_error));
}

/// A dissipative method turns what its own acceleration holds, dt^2 delta^2/8 own_a . M own_a, into motion.  So it
/// starts with none.
void AlphaStepper::restart() {
  check(VecCopy(a_, expected_a_));
  check(VecSet(own_a_, 0));
  restart_with(keeps_own_acceleration_ ? own_a_ : a_);
}

/// What the own acceleration holds must not grow with the step.
void AlphaStepper::limit_own_acceleration(double dt) {
  constexpr double rounding = 1e-9;
  if (!keeps_own_acceleration_ || taken_ == 0 || dt <= (1 + rounding) * taken_) return;
  check(VecScale(own_a_, taken_ / dt));
  restart_with(own_a_);
}

StepStart AlphaStepper::step_start() const {
  return {x_, v_, a_, keeps_mean_acceleration_ ? expected_a_ : a_,
          keeps_own_acceleration_ ? static_cast<Vec>(own_a_) : nullptr};
}

void AlphaStepper::restart_with(Vec acceleration) {
  check(VecCopy(acceleration, start_acceleration_));
  check(TSRestartStep(stepper_));
}

void AlphaStepper::begin(double t, double dt) {
  t_ = t;
  dt_ = dt;
  attempts_ = 0;
  repeats_ = 0;
  if (!keeps_mean_acceleration_) check(VecCopy(x_, x0_));
  check(VecCopy(v_, v0_));
  limit_own_acceleration(dt);
  check(TSSetTime(stepper_, t));
  check(TSSetTimeStep(stepper_, dt));
}

AlphaStepper::Outcome AlphaStepper::attempt() {
  {
    const petsc::ViewersOff quiet(!shows_while_solving_);
    check(TSStep(stepper_));
  }
  TSConvergedReason reason = TS_CONVERGED_ITERATING;
  PetscInt rejected = 0, newton = 0, linear = 0;
  PetscReal reached = 0, next = 0;
  check(TSGetConvergedReason(stepper_, &reason));
  check(TSGetStepRejections(stepper_, &rejected));
  check(TSGetSNESIterations(stepper_, &newton));
  check(TSGetKSPIterations(stepper_, &linear));
  check(TSGetTime(stepper_, &reached));
  check(TSGetTimeStep(stepper_, &next));
  const long shortened = rejected - rejected_ - repeats_;
  const Outcome outcome{reason >= 0,      shortened > 0,   shortened > 0 ? reached - t_ : dt_, next, shortened,
                        newton - newton_, linear - linear_};
  rejected_ = rejected;
  newton_ = newton;
  linear_ = linear;
  return outcome;
}

/// TSALPHA2 keeps its acceleration to itself, so it is computed again by the same formula.  Where it alternates about
/// the truth, the step's mean is kept as well.
void AlphaStepper::accept(double taken) {
  local_error_.accept(step_);
  taken_ = taken;
  if (keeps_mean_acceleration_) {
    mean_acceleration_.advance(taken, v0_, v_, a_, expected_a_);
    if (keeps_own_acceleration_) check(VecAXPBY(own_a_, 1 / step_.alpha_m, 1 - 1 / step_.alpha_m, a_));
    return;
  }
  const double beta = step_.beta, by_dt2 = 1 / (beta * taken * taken);
  check(VecAXPBYPCZ(a_, by_dt2, -by_dt2, -(1 - 2 * beta) / (2 * beta), x_, x0_));
  check(VecAXPY(a_, -1 / (beta * taken), v0_));
}

void AlphaStepper::monitor(long step, double t) { check(TSMonitor(stepper_, static_cast<PetscInt>(step), t, x_)); }

void AlphaStepper::view() { check(TSViewFromOptions(stepper_, nullptr, "-ts_view")); }

void AlphaStepper::archive(Archive& archive) {
  archive_vector(archive, "x", x_);
  archive_vector(archive, "v", v_);
  archive_vector(archive, "a", a_);
  if (keeps_own_acceleration_) archive_vector(archive, "own a", own_a_);
  archive.item("taken", taken_);
  if (keeps_mean_acceleration_) {
    archive_vector(archive, "expected a", expected_a_);
    mean_acceleration_.archive(archive);
  }
  local_error_.archive(archive);
  restart_with(keeps_own_acceleration_ ? own_a_ : a_);
}

AlphaStep AlphaStepper::read_step() const {
  PetscReal alpha_m = 0, alpha_f = 0, gamma = 0, beta = 0, dt = 0;
  check(TSAlpha2GetParams(stepper_, &alpha_m, &alpha_f, &gamma, &beta));
  check(TSGetTimeStep(stepper_, &dt));
  return {{alpha_m, alpha_f, gamma, beta}, dt};
}

PetscErrorCode AlphaStepper::residual(TS, PetscReal, Vec x, Vec v, Vec a, Vec r, void* self) noexcept {
  PetscFunctionBeginUser;
  auto& stepper = *static_cast<AlphaStepper*>(self);
  if (stepper.step_.is_start())
    PetscCall(VecWAXPY(r, -start_factor, stepper.start_acceleration_, a));
  else
    stepper.equations_.residual(x, v, a, r);
  PetscFunctionReturn(petsc::success);
}

PetscErrorCode AlphaStepper::jacobian(TS, PetscReal, Vec, Vec, Vec, PetscReal, PetscReal, Mat J, Mat P,
                                      void* self) noexcept {
  PetscFunctionBeginUser;
  static_cast<AlphaStepper*>(self)->equations_.tangent();
  if (J != P) {
    PetscCall(MatAssemblyBegin(J, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(J, MAT_FINAL_ASSEMBLY));
  }
  PetscFunctionReturn(petsc::success);
}

/// PETSc asks for a first guess before each Newton solve.
PetscErrorCode AlphaStepper::begin_solve(SNES, Vec x, void* self) noexcept {
  PetscFunctionBeginUser;
  auto& stepper = *static_cast<AlphaStepper*>(self);
  // The stepper's own vectors stay at the step's start until it is accepted.
  stepper.equations_.begin_solve(stepper.step_, stepper.step_start(), x);
  PetscFunctionReturn(petsc::success);
}

PetscErrorCode AlphaStepper::begin_stage(TS ts, PetscReal) noexcept {
  PetscFunctionBeginUser;
  AlphaStepper* stepper = nullptr;
  PetscCall(TSGetApplicationContext(ts, &stepper));
  stepper->step_ = stepper->read_step();
  if (!stepper->step_.is_start()) ++stepper->attempts_;
  // The first attempts differ in their tangents alone.
  const int attempt = stepper->attempts_;
  if (attempt > 1 && attempt <= most_of_a_length) stepper->repeats_ = attempt - 1;
  PetscCall(TSAdaptSetScaleSolveFailed(stepper->adapt_, attempt < most_of_a_length ? 1 : stepper->failed_scale_));
  stepper->equations_.begin_attempt(attempt);
  PetscFunctionReturn(petsc::success);
}

bool AlphaStepper::accepts_error() {
  if (step_.is_start()) return true;
  const Error error = [this] {
    Vec end = nullptr;
    check(SNESGetSolution(snes_, &end));
    return local_error_.estimate(step_, network_, step_start(), mean_acceleration_.growth(), end);
  };
  return accepts_(error, step_.dt);
}

/// PETSc calls this after each stage that Newton's method has solved.
PetscErrorCode AlphaStepper::check_error(TSAdapt adapt, TS ts, PetscReal, Vec, PetscBool* accept) noexcept {
  PetscFunctionBeginUser;
  AlphaStepper* stepper = nullptr;
  PetscCall(TSGetApplicationContext(ts, &stepper));
  if (stepper->accepts_error()) PetscFunctionReturn(petsc::success);
  *accept = PETSC_FALSE;
  PetscCall(TSAdaptSetScaleSolveFailed(adapt, stepper->refused_scale_));
  // Newton's method did well, so the next attempt is not a retry.
  if (stepper->attempts_ == 1) stepper->attempts_ = 0;
  PetscFunctionReturn(petsc::success);
}

}   // namespace cablenet::solve
