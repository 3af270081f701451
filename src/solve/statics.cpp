#include "cablenet/solve/statics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bed_drift.hpp"
#include "cablenet/petsc/values.hpp"
#include "cablenet/solve/relaxation.hpp"
#include "disturbance.hpp"
#include "failed_part.hpp"

namespace cablenet::solve {
namespace {

using petsc::check;
using system::StaticRule;

/// The largest unbalanced force over the largest load on a node that passes for none.
constexpr double enough = 1e-9;

/// The residual over the loads at which the next stage begins: after strings, and after ropes.
constexpr double rough = 0.05, passable = 1e-3;

/// Strings that get less and less extensible: exponents, tensions over the total load, and iterations at most.
struct StringStage {
  double exponent, tension;
  int most;
};
constexpr StringStage string_stages[] = {{1, 0.5, 4}, {3, 0.25, 20}, {9, 0.1, 20}, {27, 0.1, 20}};

/// The residual over the loads at which a descent ends for Newton's method, again and again where that does not arrive.
constexpr double descent_goals[] = {1e-3, 1e-6, 1e-8, 1e-10};
/// In a flow, the goal of the first descent.  A descent holds the drag.  Newton's method has its derivative, so it can
/// take over much earlier.
constexpr double goal_in_flow = 0.02;
constexpr int most_directly = 12, most_after_descent = 40, most_near = 20;

/// The first time that a network gets to settle, over that of a fall through its extent.
constexpr double settling_time = 10, standard_gravity = 9.80665;
/// How many times there are, each twice as long as the one before.
constexpr int longer_times = 5;
/// Larger nets are not left to settle: that would take many minutes.
constexpr int most_unknowns_of_nets = 5000;
/// What pushes with less than this, over the largest tension, or less than rounding's share, does not push.
constexpr double pushing_part = 1e-9;

/// Likewise where friction on the bed holds it.
constexpr double held_part = 1e-3;

/// The drag tells where cables lie on a bed if the unbalanced force is at most this part of the drag.
constexpr double part_of_drag = 0.01;

/// An equilibrium is near the drawn shape if no coordinate is farther from it than this, over the network's extent.
constexpr double near = 1e-3;

}   // namespace

Statics::Statics(system::Assembler& assembler, double t, const Vector3& velocity)
    : assembler_(assembler),
      t_(t),
      velocity_(velocity),
      forces_(assembler, t, velocity),
      progress_(assembler.communicator()),
      may_push_(forces_.may_push()),
      x_(assembler.make_vector()),
      drawn_(assembler.make_vector()),
      trial_(assembler.make_vector()),
      newton_(assembler, forces_, progress_, t, (assembler.fill_initial(drawn_, trial_), drawn_)) {
  check(VecCopy(drawn_, x_));
}

bool Statics::solve() {
  forces_.loads(x_, trial_);
  check(VecNorm(trial_, NORM_INFINITY, &largest_drawn_load_));
  newton_.measure_loads(x_);
  return conclude(sticks() ? find_rubbing() : find());
}

/// What is drawn in equilibrium is taken as it is, unless it bears nothing and stands on end.  Otherwise a stable shape
/// is looked for, at first one in which nothing pushes.
bool Statics::find() {
  const bool directly = newton_.settle(x_, {StaticRule::Kind::exact}, {0, most_directly, false, false});
  const bool is_drawn = directly && progress_.iterations() == 0 && newton_.load() > 0;
  if (directly) newton_.count_negative_pivots(x_);
  if (directly && is_near_drawn() && (is_drawn || !is_unstable())) return true;
  if (directly && is_taut() && !is_unstable()) return true;
  const system::Vector direct = assembler_.make_vector();
  check(VecCopy(x_, direct));
  const bool drag_rules = forces_.is_in_flow() && !assembler_.network().surroundings.bed;
  if (drag_rules ? go_by_strings() || go_down() : go_down() || go_by_strings()) return true;
  if (go_in_time()) return true;
  if (!directly) return false;
  check(VecCopy(direct, x_));
  newton_.count_negative_pivots(x_);
  return true;
}

bool Statics::sticks() const {
  const auto& bed = assembler_.network().surroundings.bed;
  return bed && bed->sticks();
}

/// What lies on the bed was laid in still water, and friction holds it there in a current.  Where friction makes cables
/// push, or leaves a shape that is not stable, it is left out: what was laid in that shape would not have stayed there.
bool Statics::find_rubbing() {
  if (velocity_.isZero(0)) forces_.still(true);
  const bool is_laid = find();
  const bool was_taut = is_laid && is_taut(), was_unstable = is_laid && is_unstable();
  forces_.still(false);
  if (!is_laid) check(VecCopy(drawn_, x_));
  forces_.let_stick(x_);
  if (rub(was_taut) && (was_unstable || !is_unstable())) return true;
  forces_.let_slide();
  check(VecCopy(drawn_, x_));
  if (progress_.is_over() || !find()) return false;
  leaves_friction_out_ = true;
  return true;
}

/// As if no cable could push, and then as the cables are, where some push.
bool Statics::rub(bool was_taut) {
  if (!rub_from_here(was_taut)) return false;
  if (!was_taut || is_taut()) return true;
  if (is_taut_enough() && rub_from_here(false)) return is_taut_enough();
  disturb(assembler_.network(), x_);
  return rub_from_here(false) && is_taut_enough();
}

/// Newton's method comes first, because the equilibrium without friction is near.  A current may have moved it away.
bool Statics::rub_from_here(bool never_pushes) {
  const system::Vector start = assembler_.make_vector();
  check(VecCopy(x_, start));
  const StaticRule exact{.kind = StaticRule::Kind::exact, .never_pushes = never_pushes};
  if (!forces_.is_in_flow() && newton_.settle(x_, exact, {0, most_near, true})) {
    newton_.count_negative_pivots(x_);
    return true;
  }
  check(VecCopy(start, x_));
  return descend(never_pushes);
}

/// Where cables carry compression there may be more equilibria than one.  One without any compression is the lowest.
bool Statics::is_taut() { return forces_.tensions(x_).least >= -slight_push(); }

/// Friction holds what pushes slightly.
bool Statics::is_taut_enough() {
  const TensionRange range = forces_.tensions(x_);
  return range.least >= -held_part * range.largest;
}

/// A frame of bars is: it is meant to stand as drawn, and its bars may carry compression.
bool Statics::is_near_drawn() {
  PetscReal moved = 0;
  check(VecWAXPY(trial_, -1, drawn_, x_));
  check(VecNorm(trial_, NORM_INFINITY, &moved));
  return moved <= near * assembler_.network().extent;
}

bool Statics::go_down() {
  check(VecCopy(drawn_, x_));
  const bool found = descend(true);
  const bool is_done = !may_push_ || (found && is_taut());
  is_there_without_pushing_ = found && !is_done;
  return (is_done ? found : let_push(found)) && (!is_unstable() || leave_saddle());
}

/// From the shape without pushing.  Newton's method comes first.  Where cables push in what it finds, there may be
/// another shape in which they do not, but in a current the shape is what drag makes it.
bool Statics::let_push(bool is_equilibrium) {
  const system::Vector without = assembler_.make_vector(), with = assembler_.make_vector();
  check(VecCopy(x_, without));
  const StaticRule predicted{.kind = StaticRule::Kind::descent};
  const bool arrived = is_equilibrium && newton_.settle(x_, predicted, {0, most_after_descent, false});
  if (arrived) newton_.count_negative_pivots(x_);
  if (arrived && (drifts() || is_taut())) return true;
  check(VecCopy(x_, with));
  check(VecCopy(without, x_));
  disturb(assembler_.network(), x_);
  if (descend(false)) return true;
  check(VecCopy(with, x_));
  if (arrived) newton_.count_negative_pivots(x_);
  return arrived;
}

/// A current moves what lies on a bed without friction.
bool Statics::drifts() const {
  return forces_.is_in_flow() && assembler_.network().surroundings.bed && !forces_.sticks();
}

/// Newton's method takes over where the residual is small, and gives back to the descent where that was not enough.
bool Statics::descend(bool never_pushes) {
  Descent descent(descent_parts(), never_pushes);
  if (drifts() && BedDrift(descent, forces_, newton_, progress_, never_pushes).find(x_)) {
    newton_.count_negative_pivots(x_);
    return true;
  }
  if (!drifts()) descent.soften(x_);
  return descend(descent, never_pushes);
}

Descent::Parts Statics::descent_parts() {
  return {assembler_, forces_, newton_.tangent(), newton_.ksp(), newton_.linear(), progress_};
}

bool Statics::descend(Descent& descent, bool never_pushes) {
  const system::Vector lowest = assembler_.make_vector();
  std::vector<double> goals(std::begin(descent_goals), std::end(descent_goals));
  if (forces_.is_in_flow()) goals.insert(goals.begin(), goal_in_flow);
  for (const double goal : goals) {
    const bool is_near = descent.go_on(x_, goal);
    check(VecCopy(x_, lowest));
    const StaticRule exact{.kind = StaticRule::Kind::exact, .never_pushes = never_pushes};
    if (newton_.settle(x_, exact, {0, most_after_descent, true})) {
      newton_.count_negative_pivots(x_);
      return true;
    }
    check(VecCopy(lowest, x_));
    if (!is_near || progress_.is_over()) break;
  }
  return false;
}

/// A slight disturbance, and down from there.  Where that finds nothing, the saddle is what there is.
bool Statics::leave_saddle() {
  const system::Vector saddle = assembler_.make_vector();
  check(VecCopy(x_, saddle));
  disturb(assembler_.network(), x_);
  if (descend(false) && !is_unstable()) return true;
  check(VecCopy(saddle, x_));
  newton_.count_negative_pivots(x_);
  return true;
}

bool Statics::go_by_strings() {
  check(VecCopy(drawn_, x_));
  StaticRule strings{StaticRule::Kind::strings};
  for (const auto& [exponent, tension, most] : string_stages) {
    newton_.measure_loads(x_);
    strings.exponent = exponent;
    strings.string_tension = tension * newton_.total_load();
    newton_.settle(x_, strings, {rough * newton_.reference(), most, true});
  }
  newton_.measure_loads(x_);
  const StaticRule start{StaticRule::Kind::ropes, strings.exponent, strings.string_tension, newton_.least_tension()};
  newton_.settle(x_, start, {std::numeric_limits<double>::min(), 1, false});
  return newton_.settle(x_, newton_.ropes(), {passable * newton_.reference(), 40, false}) &&
         newton_.settle_as_they_are(x_, 200);
}

/// As the last resort, lets the network settle in time.
bool Statics::go_in_time() {
  if (newton_.linear().factors_are_dear() && assembler_.network().all_unknowns() > most_unknowns_of_nets) return false;
  const double extent = std::max(assembler_.network().extent, std::numeric_limits<double>::min());
  double duration = settling_time * std::sqrt(extent / standard_gravity);
  check(VecCopy(drawn_, x_));
  for (int i = 0; i < longer_times && !progress_.is_over(); ++i, duration *= 2) {
    if (!relax(assembler_, t_, velocity_, duration, progress_, x_)) return false;
    check(VecCopy(x_, trial_));
    if (newton_.settle_as_they_are(x_, 20)) return true;
    check(VecCopy(trial_, x_));
  }
  return false;
}

/// Whatever was said on the way, the residual decides.  Afloat, weight and buoyancy leave next to no load in the end.
bool Statics::conclude(bool converged) {
  PetscReal load = 0, residual = 0;
  forces_.loads(x_, trial_);
  check(VecNorm(trial_, NORM_INFINITY, &load));
  load = std::max(load, largest_drawn_load_);
  newton_.evaluate({StaticRule::Kind::exact}, x_, false);
  check(VecNorm(newton_.residual(), NORM_INFINITY, &residual));
  const double drag = drifts() ? forces_.drag(x_) : 0;
  is_drag_lost_ = drag > 0 && residual > part_of_drag * drag;
  largest_load_ = load;
  imbalance_ = residual / (load > 0 ? load : std::max(newton_.scales().load, std::numeric_limits<double>::min()));
  ends_by_rounding_ = imbalance_ > enough && residual <= newton_.rounding();
  if (progress_.is_over()) failure_ = fmt::format("the time limit of {:.3g} s is over", progress_.limit());
  if (failure_.empty()) failure_ = newton_.failure();
  if (failure_.empty()) failure_ = "the iteration does not settle";
  return converged && (imbalance_ <= enough || ends_by_rounding_);
}

std::vector<std::pair<int, double>> Statics::pushing() {
  return forces_.pushing(
      x_, forces_.sticks() ? std::max(slight_push(), held_part * forces_.tensions(x_).largest) : slight_push());
}

double Statics::slight_push() { return std::max(pushing_part * forces_.tensions(x_).largest, newton_.rounding()); }

FailedPart Statics::failed_part() {
  KnownFailure known;
  if (const std::optional<PivotReport> pivots = newton_.pivots()) known.singular_node = pivots->singular_node;
  return worst_part(assembler_, newton_.residual(), known);
}

}   // namespace cablenet::solve
