#include "cablenet/solve/descent.hpp"

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

/// The softest cables' EA over the total load, and how much stiffer they become from stage to stage.
constexpr double softest = 3, hardening = 10;

/// The residual over the loads at which a stage of soft cables ends, and its iterations at most.
constexpr double rough = 0.3;
constexpr int most_of_stage = 40, most_iterations = 1000, most_of_held = 60;

/// Where there are no loads, cables stretched by this much stand in for them.
constexpr double slight_strain = 1e-3;

/// T over the total load, and what lambda may be.
constexpr double string_tension = 0.1, least_lambda = 1e-9, most_lambda = 1e6;

/// What lambda is at most where the shape is near already.
constexpr double most_lambda_near = 1e-3;

/// A correction of which more than `whole` is taken went well.  One of which less than `part` is taken did not.
constexpr double whole = 0.9, part = 0.3, easing = 0.1, tightening = 4;

/// Armijo's constant; how far the slope may rise where rounding hides the energy; that rounding, over the energy.
constexpr double sufficient = 1e-4, flat_enough = 0.9, energy_rounding = 1e-11;

/// Bodies turn against this times lambda times the torque that their forces can have.
constexpr double turning = 2;

/// How often drag is taken anew, what part of the residual is left each time, and how much of it falls where it goes
/// well.
constexpr int most_drags = 30;
constexpr double left = 0.03, falling = 0.7, least_share = 0.1;

}   // namespace

Descent::Descent(const Parts& parts, bool never_pushes) : parts_(parts) {
  rule_ = {.kind = StaticRule::Kind::descent, .never_pushes = never_pushes};
  for (auto* vector : {&r_, &loads_, &step_, &trial_}) *vector = parts_.assembler.make_vector();
}

void Descent::measure_loads(Vec x) {
  PetscReal sum = 0;
  parts_.forces.loads(x, loads_);
  check(VecNorm(loads_, NORM_1, &sum));
  const double unloaded = slight_strain * largest_stiffness();
  load_ = sum > 0 ? norm(loads_) : unloaded;
  total_load_ = sum > 0 ? sum : unloaded;
}

double Descent::holding() const { return lambda_ * string_tension * total_load_; }

void Descent::soften(Vec x) {
  lambda_ = 1;
  measure_loads(x);
  if (parts_.forces.sticks()) parts_.forces.hold_friction(x);
  const double hardest = largest_stiffness();
  for (double soft = softest * total_load_; soft < hardest && !parts_.progress.is_over(); soft *= hardening) {
    if (parts_.forces.is_in_flow()) parts_.forces.hold_drag(x);
    rule_.most_stiffness = soft;
    settle(x, rough * load_, most_of_stage);
  }
  rule_.most_stiffness = infinite;
}

void Descent::settle_held(Vec x, double goal) {
  lambda_ = std::min(lambda_, most_lambda_near);
  settle(x, goal, most_of_held);
}

double Descent::largest_stiffness() const {
  double largest = 0;
  for (const auto& material : parts_.assembler.network().materials)
    largest = std::max(largest, material.axial_stiffness);
  return largest;
}

bool Descent::go_on(Vec x, double goal) {
  measure_loads(x);
  lambda_ = std::min(lambda_, 1.0);
  if (parts_.forces.is_in_flow() || parts_.forces.sticks()) return follow(x, goal * load_);
  return settle(x, goal * load_, most_iterations);
}

/// What has no potential is held until the descent ends.  Where the residual hardly falls, drag turns with what it
/// moves, and less of it is taken anew.
bool Descent::follow(Vec x, double goal) {
  double previous = infinite, share = 1;
  for (int i = 0;; ++i) {
    let_follow();
    const double now = evaluate(x, false);
    const bool goes_on = parts_.progress.note("held", now, load_, fmt::format(", share {:.2g}", share));
    if (now <= goal || i == most_drags || !std::isfinite(now) || !goes_on) return now <= goal;
    if (now > falling * previous) share = std::max(0.5 * share, least_share);
    previous = now;
    if (parts_.forces.is_in_flow()) parts_.forces.hold_drag(x, share);
    if (parts_.forces.sticks()) parts_.forces.hold_friction(x, share);
    settle(x, std::max(left * now, left * goal), most_of_held);
  }
}

/// @param goal  of the residual [N]
bool Descent::settle(Vec x, double goal, int most) {
  parts_.forces.keep(x);
  potential_ = parts_.forces.potential(rule_, x);
  is_hidden_ = false;
  double previous = infinite;
  for (int i = 0;; ++i) {
    Slope slope{};
    rule_.holding = holding();
    const double now = evaluate(x, true);
    const std::string details =
        fmt::format(", EA {:.3g} N, potential {:.9g} J, lambda {:.2g}", rule_.most_stiffness, potential_, lambda_);
    if (!parts_.progress.note("descent", now, load_, details)) return false;
    if (now <= goal) return true;
    const bool is_rounding = is_hidden_ && now > 0.5 * previous;
    if (i == most || is_rounding || !std::isfinite(now)) return false;
    previous = now;
    parts_.progress.count();
    if (!correct(x, slope)) return false;
    const double share = search(x, slope, now);
    if (share == 0) return false;
    if (share > whole) lambda_ = std::max(lambda_ * easing, least_lambda);
    if (share < part) lambda_ = std::min(lambda_ * tightening, most_lambda);
  }
}

/// step_ = -(tangent)^-1 r.  @returns false where no strings make the tangent positive
bool Descent::correct(Vec x, Slope& slope) {
  for (;;) {
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    check(KSPSolve(parts_.ksp, r_, step_));
    check(VecScale(step_, -1));
    check(KSPGetConvergedReason(parts_.ksp, &reason));
    slope.all = dot(r_, step_);
    const std::optional<PivotReport> pivots = parts_.linear.pivots();
    if (reason < 0) parts_.linear.recover();
    if (reason >= 0 && std::isfinite(slope.all) && slope.all < 0 && (!pivots || pivots->negative == 0)) break;
    lambda_ *= 10;
    if (lambda_ > most_lambda) return false;
    rule_.holding = holding();
    evaluate(x, true);
  }
  parts_.forces.loads(x, loads_);
  slope.loads = dot(loads_, step_);
  return true;
}

/// Goes along the correction.  @returns the part of it that was taken, or 0 where the energy falls nowhere
double Descent::search(Vec x, const Slope& slope, double now) {
  parts_.forces.keep(x);
  double share = 1;
  for (int i = 0; i < 30; ++i) {
    check(VecWAXPY(trial_, share, step_, x));
    const double then = evaluate(trial_, false);
    end_slope_ = infinite;
    if (std::isfinite(then)) {
      const double potential = parts_.forces.potential(rule_, trial_);
      if (is_lower(slope, share, now, then, potential)) {
        check(VecCopy(trial_, x));
        potential_ = potential;
        return share;
      }
    }
    const double shorter = end_slope_ > 0 ? slope.all / (slope.all - end_slope_) : 0.5;
    share *= std::clamp(shorter, 0.1, 0.6);
  }
  return 0;
}

/// Whether the trial is.  The work of the loads is by the trapezoidal rule, which is exact for weight.
bool Descent::is_lower(const Slope& slope, double share, double now, double then, double potential) {
  parts_.forces.loads(trial_, loads_);
  end_slope_ = dot(r_, step_);
  const double change = potential - potential_ + 0.5 * share * (slope.loads + dot(loads_, step_));
  if (change <= sufficient * share * slope.all) return true;
  is_hidden_ = -share * slope.all <= energy_rounding * std::abs(potential_);
  return is_hidden_ && (std::abs(end_slope_) <= -flat_enough * slope.all || then < now);
}

double Descent::evaluate(Vec x, bool with_tangent) {
  const Steadying steadying{0, turning * lambda_, true};
  int in_domain = parts_.forces.residual(rule_, x, r_, with_tangent ? &parts_.tangent : nullptr, steadying) ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &in_domain, 1, MPI_INT, MPI_LAND, parts_.assembler.communicator());
  return in_domain != 0 ? norm(r_) : infinite;
}

}   // namespace cablenet::solve
