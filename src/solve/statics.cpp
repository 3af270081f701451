#include "cablenet/solve/statics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cablenet/solve/own_options.hpp"
#include "cablenet/solve/relaxation.hpp"
#include "failed_part.hpp"

namespace cablenet::solve {
namespace {

using petsc::check;
using system::StaticRule;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The residual over the loads.  Iterating ends at `wanted`.  Where rounding ends it before, `enough` will do.
constexpr double wanted = 1e-12, enough = 1e-9;

/// A residual of so many times what rounding makes alone passes as rounding.
constexpr double rounding_margin = 16;

/// How far away an equilibrium may be, over the size of what is drawn.  What falls without end comes to coordinates
/// whose rounding hides the loads.  It would pass as an equilibrium.
constexpr double farthest = 1e6;

/// The least tension that the tangent has a rope turn with, over the total load.
constexpr double slack_tension = 1e-4;

/// The residual over the loads at which the next stage begins: after strings, and after ropes.
constexpr double rough = 0.05, passable = 1e-3;

/// Strings that get less and less extensible: exponents, tensions over the total load, and iterations at most.
struct StringStage {
  double exponent, tension;
  int most;
};
constexpr StringStage string_stages[] = {{1, 0.5, 4}, {3, 0.25, 20}, {9, 0.1, 20}, {27, 0.1, 20}};

/// Where less than this share of a correction is taken, the next one is made in a shorter pseudo-time.
constexpr double short_step = 0.15;

/// The first time that a network gets to settle, over that of a fall through its extent.
constexpr double settling_time = 10, standard_gravity = 9.80665;
/// How many times there are, each twice as long as the one before.
constexpr int longer_times = 5;
/// Larger nets are not left to settle: that would take many minutes, without a word.
constexpr int most_unknowns_of_nets = 5000;

/// An equilibrium is near the drawn shape if no coordinate is farther from it than this, over the network's extent.
constexpr double near = 1e-3;

constexpr double first_shift = 0.01, largest_shift = 1e6, shift_growth = 10;   // [1/s], [1/s], 1

double norm(Vec v) {
  PetscReal value = 0;
  check(VecNorm(v, NORM_2, &value));
  return value;
}

double dot(Vec a, Vec b) {
  PetscScalar value = 0;
  check(VecDot(a, b, &value));
  return value;
}

}   // namespace

Statics::Statics(system::Assembler& assembler, double t, const Vector3& velocity)
    : assembler_(assembler),
      t_(t),
      velocity_(velocity),
      forces_(assembler, t, velocity),
      is_in_flow_(forces_.is_in_flow()),
      tangent_(assembler.make_tangent()),
      monitors_(petsc::flag_option(assembler.communicator(), nullptr, statics_monitor_option.text)) {
  for (auto* vector : {&x_, &drawn_, &r_, &step_, &trial_}) *vector = assembler_.make_vector();
  assembler_.fill_initial(drawn_, r_);
  scales_ = assembler_.force_scales(t, drawn_, r_);
  for (const Vector3& position : assembler_.network().position)
    largest_drawn_coordinate_ = std::max(largest_drawn_coordinate_, position.lpNorm<Eigen::Infinity>());
  MPI_Allreduce(MPI_IN_PLACE, &largest_drawn_coordinate_, 1, MPI_DOUBLE, MPI_MAX, assembler_.communicator());
  check(VecCopy(drawn_, x_));
  check(KSPCreate(assembler_.communicator(), ksp_.out()));
  linear_ = LinearSolver(ksp_, assembler_.network(), tangent_.matrix());
}

void Statics::measure_loads() {
  PetscReal sum = 0;
  forces_.loads(x_, r_);
  check(VecNorm(r_, NORM_1, &sum));
  load_ = norm(r_);
  total_load_ = std::max<double>(sum, std::numeric_limits<double>::min());
}

bool Statics::solve() {
  measure_loads();
  const bool directly = go_directly();
  if (directly && (is_near_drawn() || is_taut())) {
    count_negative_pivots();
    return conclude(true);
  }
  const system::Vector direct = assembler_.make_vector();
  check(VecCopy(x_, direct));
  if (go_by_strings() || go_in_time()) return conclude(true);
  if (directly) {
    check(VecCopy(direct, x_));
    count_negative_pivots();
  }
  return conclude(directly);
}

/// Where cables carry compression there may be more equilibria than one.  One without any compression is the lowest.
bool Statics::is_taut() {
  const TensionRange tensions = forces_.tensions(x_);
  return tensions.least >= -enough * tensions.largest;
}

/// A frame of bars is: it is meant to stand as drawn, and its bars may carry compression.
bool Statics::is_near_drawn() {
  PetscReal moved = 0;
  check(VecWAXPY(trial_, -1, drawn_, x_));
  check(VecNorm(trial_, NORM_INFINITY, &moved));
  return moved <= near * assembler_.network().extent;
}

/// Newton's method on the cables as they are.
bool Statics::go_directly() {
  shift_ = 0;
  return settle({StaticRule::Kind::exact}, {0, 12, false, false});
}

bool Statics::go_by_strings() {
  check(VecCopy(drawn_, x_));
  shift_ = 0;
  StaticRule strings{StaticRule::Kind::strings};
  for (const auto& [exponent, tension, most] : string_stages) {
    measure_loads();
    strings.exponent = exponent;
    strings.string_tension = tension * total_load_;
    settle(strings, {rough * reference(), most, true});
  }
  measure_loads();
  const StaticRule start{StaticRule::Kind::ropes, strings.exponent, strings.string_tension, least_tension()};
  settle(start, {std::numeric_limits<double>::min(), 1, false});
  return settle(ropes(), {passable * reference(), 40, false}) && settle_as_they_are(200);
}

/// What carries compression may stand on end, where nothing but rounding would topple it.  Negative pivots tell.
bool Statics::settle_as_they_are(int iterations) {
  if (!settle({StaticRule::Kind::exact}, {0, iterations, true})) return false;
  count_negative_pivots();
  return negative_pivots_ == 0;
}

/// Of a tangent at the shape that was found.  The last correction had that of the shape before it, and a shape that is
/// drawn in equilibrium takes no correction.
void Statics::count_negative_pivots() {
  // Without a shift, the pivots of what drifts freely are rounding, of either sign.
  shift_ = first_shift;
  evaluate({StaticRule::Kind::exact}, x_, true);
  factor_and_solve();
}

/// As the last resort, lets the network settle in time.
bool Statics::go_in_time() {
  if (linear_.factors_are_dear() && assembler_.network().all_unknowns() > most_unknowns_of_nets) return false;
  const double extent = std::max(assembler_.network().extent, std::numeric_limits<double>::min());
  double duration = settling_time * std::sqrt(extent / standard_gravity);
  check(VecCopy(drawn_, x_));
  for (int i = 0; i < longer_times; ++i, duration *= 2) {
    if (!relax(assembler_, t_, velocity_, duration, x_)) return false;
    check(VecCopy(x_, trial_));
    shift_ = 0;
    if (settle_as_they_are(20)) return true;
    check(VecCopy(trial_, x_));
  }
  return false;
}

double Statics::least_tension() const { return slack_tension * total_load_; }

StaticRule Statics::ropes() const { return {StaticRule::Kind::ropes, 0, 0, least_tension()}; }

/// What residuals are measured by: the loads, or the cables' pull where there are no loads.  [N]
double Statics::reference() const { return load_ > 0 ? load_ : scales_.load; }

bool Statics::is_final(double now, double previous) const {
  const double noise = scales_.rounding(largest_coordinate_, 0);
  if (now <= wanted * reference()) return true;
  const bool is_lost = largest_coordinate_ > farthest * (largest_drawn_coordinate_ + assembler_.network().extent);
  return now > 0.5 * previous && (now <= enough * reference() || (!is_lost && now <= rounding_margin * noise));
}

/// Iterates with a rule.  @returns whether the goal was reached
bool Statics::settle(StaticRule rule, const Goal& goal) {
  const double least = rule.least_tension;
  double previous = infinite;
  if (rule.kind != StaticRule::Kind::ropes || rule.string_tension > 0) forces_.keep(x_);
  for (int i = 0;; ++i) {
    check(VecNorm(x_, NORM_INFINITY, &largest_coordinate_));
    largest_coordinate_ = std::max(largest_coordinate_, largest_drawn_coordinate_);
    steadiness_ = std::min(1.0, previous / (rough * reference()));
    rule.least_tension = steadiness_ * least;
    const double now = evaluate(rule, x_, true);
    if (monitors_)
      check(PetscPrintf(assembler_.communicator(),
                        "  statics %d, rule %d, exponent %.3g: residual %.6g N, shift %.3g\n", iterations_,
                        static_cast<int>(rule.kind), rule.exponent, now, shift_));
    if (!std::isfinite(now)) return false;
    if (goal.norm > 0 ? now <= goal.norm : is_final(now, previous)) return true;
    if (i == goal.iterations) return false;
    previous = now;
    ++iterations_;
    if (!correct(rule, goal.may_shift)) return false;
    forces_.keep(x_);
    const double share = search(rule, now, goal.searches);
    if (share < short_step) shift_ = std::max(first_shift, shift_growth * shift_growth * shift_);
    check(VecAXPY(x_, share, step_));
  }
}

/// step_ = -(tangent)^-1 r, with a shift where it takes one.  @returns false where none helps
bool Statics::correct(const StaticRule& rule, bool may_shift) {
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
    evaluate(rule, x_, true);
  }
  const double used = shift_;
  shift_ = used > first_shift ? used / shift_growth : 0;
  return true;
}

bool Statics::factor_and_solve() {
  check(KSPSolve(ksp_, r_, step_));
  check(VecScale(step_, -1));
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  check(KSPGetConvergedReason(ksp_, &reason));
  negative_pivots_ = 0;
  // With drag the tangent is unsymmetric, and pivots tell nothing of stability.
  const std::optional<PivotReport> pivots = is_in_flow_ ? std::nullopt : linear_.pivots();
  if (pivots) negative_pivots_ = pivots->negative;
  if (reason < 0) linear_.recover();
  return reason >= 0 && negative_pivots_ == 0 && std::isfinite(norm(step_));
}

/// @returns the share of the step to take.  The whole step goes too far where the force along it has turned round and
/// is nearly as large as before, as beyond a minimum.  It is taken all the same where the residual falls, as in drag.
double Statics::search(const StaticRule& rule, double now, bool searches) {
  const double before = -dot(step_, r_);
  double share = 1;
  for (int i = 0; i < 8; ++i) {
    check(VecWAXPY(trial_, share, step_, x_));
    const double then = evaluate(rule, trial_, false);
    const double after = std::isfinite(then) ? -dot(step_, r_) : -infinite;
    const bool descends = before > 0 && after >= -0.8 * before;
    if (std::isfinite(then) && (!searches || descends || then < now)) return share;
    const double shorter = std::isfinite(after) && before > 0 ? before / (before - after) : 0.3;
    share *= std::clamp(shorter, 0.1, 0.7);
  }
  return share;
}

double Statics::evaluate(const StaticRule& rule, Vec x, bool with_tangent) {
  int in_domain = forces_.residual(rule, x, r_, with_tangent ? &tangent_ : nullptr, {shift_, steadiness_}) ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &in_domain, 1, MPI_INT, MPI_LAND, assembler_.communicator());
  return in_domain != 0 ? norm(r_) : infinite;
}

bool Statics::conclude(bool converged) {
  PetscReal load = 0, residual = 0;
  forces_.loads(x_, r_);
  check(VecNorm(r_, NORM_INFINITY, &load));
  evaluate({StaticRule::Kind::exact}, x_, false);
  check(VecNorm(r_, NORM_INFINITY, &residual));
  largest_load_ = load;
  imbalance_ = residual / (load > 0 ? load : std::max(scales_.load, std::numeric_limits<double>::min()));
  if (!converged && failure_.empty()) failure_ = "the iteration does not settle";
  return converged;
}

FailedPart Statics::failed_part() {
  KnownFailure known;
  if (const std::optional<PivotReport> pivots = linear_.pivots()) known.singular_node = pivots->singular_node;
  return worst_part(assembler_, r_, known);
}

}   // namespace cablenet::solve
