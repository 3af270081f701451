#include "cablenet/solve/newton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "cablenet/base/errors.hpp"
#include "cablenet/petsc/options.hpp"
#include "cablenet/petsc/values.hpp"
#include "failed_part.hpp"
#include "snes_options.hpp"

namespace cablenet::solve {
namespace {

using petsc::check;

/// Newton's tolerance over the forces.
constexpr double relative_force_tolerance = 3e-13;

/// Beside NewtonProgress, which ends what gets nowhere.
constexpr PetscInt most_iterations = 100;

/// In a cycle, over the whole one.
constexpr double shortest_correction = 0.125;

/// The attempt with the tangent of the equations, and the first one that searches along its corrections.
constexpr int exact_attempt = 3, first_search = 5;

/// A correction below this part of the positions' rounding is none.
constexpr double smallest_correction = 1;

/// What SNESSetLagJacobian calls never to compute a tangent.
constexpr PetscInt never = -1;

const char* prefix_of(SNES snes) {
  const char* prefix = nullptr;
  check(SNESGetOptionsPrefix(snes, &prefix));
  return prefix == nullptr ? "" : prefix;
}

bool is_of_type(PetscObject object, const char* type) {
  PetscBool matches = PETSC_FALSE;
  check(PetscObjectTypeCompare(object, type, &matches));
  return matches == PETSC_TRUE;
}

}   // namespace

Newton::Newton(system::Assembler& assembler)
    : assembler_(assembler), tangent_(assembler.make_tangent()), probe_(assembler.make_vector()) {
  const system::Vector x = assembler.make_vector(), v = assembler.make_vector();
  assembler.fill_initial(x, v);
  scales_ = assembler.force_scales(0, x, v);
}

void Newton::configure(SNES snes) {
  snes_ = snes;
  SNESLineSearch search = nullptr;
  KSP ksp = nullptr;
  check(SNESGetLineSearch(snes, &search));
  check(SNESLineSearchSetType(search, SNESLINESEARCHBASIC));
  // A good first guess makes relative tests unreachable, and Newton's first correction may pass through a much larger
  // residual (a turned stiff element is a stretched one), so the divergence test is off.
  check(SNESSetTolerances(snes, relative_force_tolerance * scales_.load, 0, 0, most_iterations, petsc::unlimited));
  check(SNESSetDivergenceTolerance(snes, petsc::unlimited));
  check(SNESSetConvergenceTest(snes, converged, this, nullptr));
  check(SNESGetKSP(snes, &ksp));
  linear_ = LinearSolver(ksp, assembler_.network(), tangent_.matrix());
}

/// Where the user gave a tolerance, that one holds.
void Newton::scale_tolerance() {
  if (petsc::has_option("-snes_atol", prefix_of(snes_))) return;
  PetscReal of_norm = 0, of_step = 0;
  PetscInt iterations = 0, evaluations = 0;
  check(SNESGetTolerances(snes_, nullptr, &of_norm, &of_step, &iterations, &evaluations));
  check(SNESSetTolerances(snes_, relative_force_tolerance * scales_.load, of_norm, of_step, iterations, evaluations));
}

void Newton::adopt_options() {
  const char* const prefix = prefix_of(snes_);
  user_line_search_ = petsc::has_option("-snes_linesearch_type", prefix) || petsc::has_option("-snes_type", prefix);
  makes_tangents_ = makes_tangents(prefix);
  reuse_ = TangentReuse(makes_tangents_ && linear_.factors_are_dear());
  // Other line searches evaluate residuals elsewhere while they use the tangent.
  combines_ = makes_tangents_ && reuse_.computes_always() && has_basic_line_search();
  if (makes_tangents_) check(SNESSetLagJacobian(snes_, never));
  if (!makes_tangents_ || !suits_probes(assembler_) || !given_snes_options_only_watch(prefix)) probe_.turn_off();
}

bool Newton::makes_tangents(const char* prefix) const {
  return is_of_type(reinterpret_cast<PetscObject>(snes_), SNESNEWTONLS) && given_snes_options_are_harmless(prefix);
}

bool Newton::has_basic_line_search() const {
  SNESLineSearch search = nullptr;
  check(SNESGetLineSearch(snes_, &search));
  return is_of_type(reinterpret_cast<PetscObject>(search), SNESLINESEARCHBASIC);
}

void Newton::choose_line_search(bool searches) {
  if (user_line_search_) return;
  SNESLineSearch search = nullptr;
  check(SNESGetLineSearch(snes_, &search));
  check(SNESLineSearchSetType(search, searches ? SNESLINESEARCHBT : SNESLINESEARCHBASIC));
}

void Newton::solve_acceleration(double t, Vec x, Vec v, Vec a) {
  const system::Vector force = assembler_.make_vector();
  assembler_.force(t, x, v, force);
  assembler_.mass_matrix(t, x, v, tangent_);
  tangent_.publish();
  const KSPConvergedReason reason = linear_.solve_outside_newton(tangent_.matrix(), force, a);
  if (reason < 0)
    throw SolverError(
        fmt::format("the first acceleration could not be solved for: the linear solver stopped with {}; "
                    "try it without -ksp_type and -pc_type options",
                    KSPConvergedReasons[reason]));
}

void Newton::begin_step(double t, Vec x, Vec v, bool measures) {
  t_ = t;
  if (!measures) return;
  PetscReal largest = 0;
  check(VecNorm(x, NORM_INFINITY, &largest));
  scales_ = assembler_.force_scales(t, x, v);
  scale_tolerance();
  // Bodies have sines and cosines of angles.  However small an angle is, they are rounded as numbers of size 1.
  largest_coordinate_ = assembler_.network().blocks.uniform() ? largest : std::max<double>(largest, 1);
}

void Newton::end_step(long iterations) {
  probe_.end_solve(convergence_.was_in_doubt());
  expected_iterations_ = iterations;
}

void Newton::begin_attempt(int attempt) {
  outside_element_ = outside_body_ = -1;
  if (attempt >= first_search || searches_) choose_line_search(attempt >= first_search);
  searches_ = attempt >= first_search;
  attempt_ = attempt;
  if (attempt > 1) probe_.forget();
}

void Newton::begin_solve(const AlphaStep& step, const StepStart& start, Vec guess) {
  step_ = step;
  evaluations_ = 0;
  tangents_ = 0;
  progress_ = {};
  first_correction_ = 0;
  tangent_at_ = {};
  reuse_.begin_solve(step.is_start() ? -step.dt : step.dt, attempt_ > 1);
  if (step.is_start()) return;
  const double share = start.own_a != nullptr ? step.share_of_mean() : 1, half_square = step.dt * step.dt / 2;
  check(VecAXPBYPCZ(guess, step.dt, share * half_square, 1, start.v, start.expected_a));
  if (start.own_a != nullptr) check(VecAXPY(guess, (1 - share) * half_square, start.own_a));
  probe_.begin_solve(step.dt, start.x, guess);
  convergence_.begin_solve(probe_.farther());
}

void Newton::residual(Vec x, Vec v, Vec a, Vec r) {
  x_ = x;
  v_ = v;
  a_ = a;
  // Newton's method needs the tangent after each residual but the last: one pass makes both where another correction
  // is expected.
  const bool wants_tangent = combines_ && attempt_ <= 1 && evaluations_ < expected_iterations_;
  const system::TangentRequest request = tangent_request();
  ++evaluations_;
  if (wants_tangent) tangent_at_ = petsc::state_of(x), ++tangents_;
  if (assembler_.residual(stage(), x, v, a, r, wants_tangent ? &request : nullptr)) return;
  outside_element_ = assembler_.coincident_element();
  outside_body_ = assembler_.outside_body();
  // PETSc's own flag for this stays on one rank, and its line searches then leave the others waiting.  An infinite
  // residual reaches all ranks by its norm.
  PetscInt count = 0;
  check(VecGetLocalSize(r, &count));
  std::fill_n(static_cast<double*>(petsc::WrittenValues(r)), count, std::numeric_limits<double>::infinity());
}

void Newton::tangent() {
  reuse_.note_computed();
  if (step_.is_start()) {
    tangent_.set_identity(step_.shift_a());
    return;
  }
  if (petsc::state_of(x_) != tangent_at_) {
    assembler_.tangent(stage(), x_, v_, a_, tangent_request());
    ++tangents_;
  }
  tangent_.publish();
  tangent_at_ = {};
}

system::TangentRequest Newton::tangent_request() {
  return {.matrix = tangent_, .shift = {1, step_.shift_v(), step_.shift_a()}, .turning = turning()};
}

bool Newton::predicts() const { return attempt_ != exact_attempt; }

/// Where the first attempt fails, or goes round in a cycle, compression turns nothing: it makes tangents indefinite.
/// That leads slack ropes to the end.  Bars that push need the tangent of the equations, which the third attempt has.
bool Newton::clamps() const { return predicts() && (attempt_ > 1 || progress_.cycles()); }

system::TurningRule Newton::turning() const {
  if (!predicts()) return {};
  system::TurningRule rule{.is_predicted = true, .is_first = tangents_ == 0};
  if (clamps()) rule.least = 0;
  return rule;
}

/// Shorter corrections lead out of a cycle, and whole ones go on from there.
void Newton::shorten_where_it_returns() {
  const double before = length_;
  if (progress_.returns()) length_ = std::max(0.5 * length_, shortest_correction);
  if (progress_.is_best()) length_ = 1;
  if (length_ == before || user_line_search_) return;
  SNESLineSearch search = nullptr;
  check(SNESGetLineSearch(snes_, &search));
  check(SNESLineSearchSetDamping(search, length_));
}

/// Whatever the residual, which such a correction cannot bring down.
bool Newton::is_at_positions_rounding(double correction, double positions) const {
  const bool is_full = !searches_ && !user_line_search_ && length_ == 1;
  return is_full && correction <= smallest_correction * std::numeric_limits<double>::epsilon() * positions;
}

bool Newton::is_at_rounding(PetscInt iteration, double norm, double correction, double noise) {
  const bool careful = searches_ || (user_line_search_ && iteration > 0);
  const bool settled =
      convergence_.is_at_rounding(static_cast<int>(iteration), norm, correction, noise, careful, converges_linearly());
  if (iteration > 0) reuse_.note_correction(static_cast<int>(iteration), convergence_.contraction());
  return settled;
}

/// PETSc's default test, and rounding: a relative test is of no use with a good first guess.
SNESConvergedReason Newton::test(PetscInt iteration, PetscReal xnorm, PetscReal snorm, PetscReal fnorm) {
  SNESConvergedReason reason = SNES_CONVERGED_ITERATING;
  check(SNESConvergedDefault(snes_, iteration, xnorm, snorm, fnorm, &reason, nullptr));
  if (iteration == 1) first_correction_ = snorm / probe_.farther();
  const bool linear_and_solved = step_.is_start() && iteration >= 1;
  const double noise = this->noise();
  bool settled = !step_.is_start() && is_at_rounding(iteration, fnorm, snorm, noise);
  if (iteration > 0 && !converges_linearly()) settled = settled || is_at_positions_rounding(snorm, xnorm);
  if (reason == SNES_CONVERGED_ITERATING && (settled || linear_and_solved)) reason = SNES_CONVERGED_FNORM_ABS;
  progress_.note(static_cast<int>(iteration), fnorm, NewtonConvergence::most_of_noise * noise);
  shorten_where_it_returns();
  if (reason == SNES_CONVERGED_ITERATING && !progress_.goes_on()) reason = SNES_DIVERGED_MAX_IT;
  return reason;
}

PetscErrorCode Newton::converged(SNES, PetscInt iteration, PetscReal xnorm, PetscReal snorm, PetscReal fnorm,
                                 SNESConvergedReason* reason, void* self) noexcept {
  PetscFunctionBeginUser;
  auto& newton = *static_cast<Newton*>(self);
  *reason = newton.test(iteration, xnorm, snorm, fnorm);
  const bool goes_on = *reason == SNES_CONVERGED_ITERATING;
  if (goes_on && newton.makes_tangents_ && newton.reuse_.wants_new()) newton.tangent();
  PetscFunctionReturn(petsc::success);
}

bool Newton::has_converged() const {
  SNESConvergedReason reason = SNES_CONVERGED_ITERATING;
  check(SNESGetConvergedReason(snes_, &reason));
  return reason > 0;
}

std::string Newton::explain_failure(double dt) {
  SNESConvergedReason reason = SNES_CONVERGED_ITERATING;
  check(SNESGetConvergedReason(snes_, &reason));
  std::string text =
      fmt::format("Newton's method failed ({}) with steps down to {:.3g} s", SNESConvergedReasons[reason], dt);
  const std::optional<PivotReport> pivots = linear_.pivots();
  if (!pivots) return text;
  singular_node_ = pivots->singular_node;
  if (singular_node_.exists()) text += "; the tangent is singular there";
  if (pivots->negative > 0) text += fmt::format("; the tangent has {} negative pivots", pivots->negative);
  return text;
}

FailedPart Newton::failed_part(int known_body) {
  Vec r = nullptr;
  check(SNESGetFunction(snes_, &r, nullptr, nullptr));
  return worst_part(assembler_, r, {singular_node_, outside_element_, known_body >= 0 ? known_body : outside_body_});
}

/// The tangent is not saved: the stepper restarts, and the solves of its start ask for a new one.
void Newton::archive(Archive& archive) {
  archive.item("newton.load", scales_.load);
  if (archive.is_loading()) scale_tolerance();
  archive.item("newton.expected_iterations", expected_iterations_);
  archive.item("newton.largest_coordinate", largest_coordinate_);
  convergence_.archive(archive);
  probe_.archive(archive);
}

}   // namespace cablenet::solve
