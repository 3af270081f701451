#include "cablenet/solve/static_newton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "vector_sums.hpp"

namespace cablenet::solve {
namespace {

using petsc::check;
using system::StaticRule;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The residual over the loads.  Iterating ends at `wanted`.  Where rounding ends it before, `enough` will do, also of
/// the largest component over the largest load on a node.
constexpr double wanted = 1e-12, enough = 1e-9;

/// A residual of so many times what rounding makes alone passes as rounding.
constexpr double rounding_margin = 16;

/// How far away an equilibrium may be, over the size of what is drawn.  What falls without end comes to coordinates
/// whose rounding hides the loads.  It would pass as an equilibrium.
constexpr double farthest = 1e6;

/// The least tension that the tangent has a rope turn with, over the total load.
constexpr double slack_tension = 1e-4;

/// The residual over the loads from which on bodies' turning is steadied less and less.
constexpr double rough = 0.05;

/// While the residual over the loads is larger than this, slopes are as in environment::StickFriction::is_cautious.
constexpr double cautious = 1e-4;

/// Where less than this share of a correction is taken, the next one is made in a shorter pseudo-time.
constexpr double short_step = 0.15;

/// What keeps tangents definite.
constexpr double first_shift = 0.01, largest_shift = 1e6, shift_growth = 10;   // [1/s], [1/s], 1

const char* way_of(const StaticRule& rule) {
  switch (rule.kind) {
    case StaticRule::Kind::strings:
      return "strings";
    case StaticRule::Kind::ropes:
      return "ropes";
    case StaticRule::Kind::descent:
      return "softened";
    default:
      return "exact";
  }
}

}   // namespace

StaticNewton::StaticNewton(system::Assembler& assembler, StaticForces& forces, StaticProgress& progress, double t,
                           Vec drawn)
    : assembler_(assembler), forces_(forces), progress_(progress), tangent_(assembler.make_tangent()) {
  for (auto* vector : {&r_, &step_, &trial_}) *vector = assembler_.make_vector();
  scales_ = assembler_.force_scales(t, drawn, r_);
  for (const Vector3& position : assembler_.network().position)
    largest_drawn_coordinate_ = std::max(largest_drawn_coordinate_, position.lpNorm<Eigen::Infinity>());
  MPI_Allreduce(MPI_IN_PLACE, &largest_drawn_coordinate_, 1, MPI_DOUBLE, MPI_MAX, assembler_.communicator());
  largest_coordinate_ = largest_drawn_coordinate_;
  check(KSPCreate(assembler_.communicator(), ksp_.out()));
  linear_ = LinearSolver(ksp_, assembler_.network(), tangent_.matrix());
}

void StaticNewton::measure_loads(Vec x) {
  PetscReal sum = 0;
  forces_.loads(x, r_);
  check(VecNorm(r_, NORM_1, &sum));
  PetscReal largest = 0;
  check(VecNorm(r_, NORM_INFINITY, &largest));
  largest_load_ = std::max<double>(largest_load_, largest);
  load_ = norm(r_);
  total_load_ = std::max<double>(sum, std::numeric_limits<double>::min());
}

bool StaticNewton::settle_as_they_are(Vec x, int iterations) {
  if (!settle(x, {StaticRule::Kind::exact}, {0, iterations, true})) return false;
  count_negative_pivots(x);
  return !is_unstable();
}

void StaticNewton::count_negative_pivots(Vec x) {
  // Without a shift, the pivots of what drifts freely are rounding, of either sign.
  shift_ = first_shift;
  is_cautious_ = false;
  if (forces_.is_in_flow()) forces_.hold_drag(x);
  if (forces_.sticks()) forces_.hold_friction(x);
  evaluate({StaticRule::Kind::exact}, x, true);
  factor_and_solve();
  forces_.let_drag_follow();
  forces_.let_friction_follow();
  shift_ = 0;
}

double StaticNewton::least_tension() const { return slack_tension * total_load_; }

StaticRule StaticNewton::ropes() const { return {StaticRule::Kind::ropes, 0, 0, least_tension()}; }

double StaticNewton::rounding() const { return rounding_margin * scales_.rounding(largest_coordinate_, 0); }

bool StaticNewton::is_final(double now, double previous) const {
  if (now <= wanted * reference()) return true;
  if (now <= 0.5 * previous) return false;
  PetscReal largest = 0;
  check(VecNorm(r_, NORM_INFINITY, &largest));
  const bool is_enough = now <= enough * reference() && (load_ == 0 || largest <= enough * largest_load_);
  const bool is_lost = largest_coordinate_ > farthest * (largest_drawn_coordinate_ + assembler_.network().extent);
  return is_enough || (!is_lost && now <= rounding());
}

bool StaticNewton::settle(Vec x, StaticRule rule, const StaticGoal& goal) {
  const double least = rule.least_tension;
  double previous = infinite;
  shift_ = 0;
  if (goal.norm == 0) measure_loads(x);
  if (rule.kind != StaticRule::Kind::ropes || rule.string_tension > 0) forces_.keep(x);
  for (int i = 0;; ++i) {
    check(VecNorm(x, NORM_INFINITY, &largest_coordinate_));
    largest_coordinate_ = std::max(largest_coordinate_, largest_drawn_coordinate_);
    steadiness_ = std::min(1.0, previous / (rough * reference()));
    is_cautious_ = previous > cautious * reference();
    rule.least_tension = steadiness_ * least;
    const double now = evaluate(rule, x, true);
    const std::string details = fmt::format(", exponent {:.3g}, shift {:.3g}", rule.exponent, shift_);
    if (!progress_.note(way_of(rule), now, reference(), details) || !std::isfinite(now)) return false;
    if (goal.norm > 0 ? now <= goal.norm : is_final(now, previous)) return true;
    if (i == goal.iterations) return false;
    previous = now;
    progress_.count();
    if (!correct(x, rule, goal.may_shift)) return false;
    forces_.keep(x);
    const double share = search(x, rule, now, goal);
    if (share < short_step) shift_ = std::max(first_shift, shift_growth * shift_growth * shift_);
    check(VecAXPY(x, share, step_));
  }
}

/// step_ = -(tangent)^-1 r, with a shift where it takes one.  @returns false where none helps
bool StaticNewton::correct(Vec x, const StaticRule& rule, bool may_shift) {
  while (!factor_and_solve()) {
    if (!may_shift) return false;
    if (steadiness_ < 1)
      steadiness_ = 1;
    else
      shift_ = std::max(first_shift, shift_growth * shift_);
    if (shift_ > largest_shift) {
      failure_ = "the tangent is singular";
      return false;
    }
    evaluate(rule, x, true);
  }
  const double used = shift_;
  shift_ = used > first_shift ? used / shift_growth : 0;
  return true;
}

bool StaticNewton::factor_and_solve() {
  check(KSPSolve(ksp_, r_, step_));
  check(VecScale(step_, -1));
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  check(KSPGetConvergedReason(ksp_, &reason));
  negative_pivots_ = 0;
  // With drag or friction the tangent is unsymmetric, and pivots tell nothing of stability.
  const bool tells = (!forces_.is_in_flow() || forces_.holds_drag()) && (!forces_.sticks() || forces_.holds_friction());
  const std::optional<PivotReport> pivots = tells ? linear_.pivots() : std::nullopt;
  if (pivots) negative_pivots_ = pivots->negative;
  if (reason < 0) linear_.recover();
  return reason >= 0 && negative_pivots_ == 0 && std::isfinite(norm(step_));
}

/// @returns the share of the step to take.  The whole step goes too far where the force along it has turned round and
/// is nearly as large as before: a minimum lies between.  It is taken all the same where the residual falls, as in
/// drag.
double StaticNewton::search(Vec x, const StaticRule& rule, double now, const StaticGoal& goal) {
  const double before = -dot(step_, r_);
  double share = std::isfinite(goal.most_turn) ? share_of_turn(x, goal.most_turn) : 1;
  for (int i = 0; i < 8; ++i) {
    check(VecWAXPY(trial_, share, step_, x));
    const double then = evaluate(rule, trial_, false);
    const double after = std::isfinite(then) ? -dot(step_, r_) : -infinite;
    const bool descends = before > 0 && after >= -0.8 * before;
    if (std::isfinite(then) && (!goal.searches || descends || then < now)) return share;
    const double shorter = std::isfinite(after) && before > 0 ? before / (before - after) : 0.3;
    share *= std::clamp(shorter, 0.1, 0.7);
  }
  return share;
}

double StaticNewton::share_of_turn(Vec x, double most_turn) {
  check(VecWAXPY(trial_, 1, step_, x));
  return std::min(1.0, most_turn / forces_.largest_turn(x, trial_));
}

double StaticNewton::evaluate(const StaticRule& rule, Vec x, bool with_tangent) {
  int in_domain =
      forces_.residual(rule, x, r_, with_tangent ? &tangent_ : nullptr, {shift_, steadiness_, is_cautious_}) ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &in_domain, 1, MPI_INT, MPI_LAND, assembler_.communicator());
  return in_domain != 0 ? norm(r_) : infinite;
}

}   // namespace cablenet::solve
