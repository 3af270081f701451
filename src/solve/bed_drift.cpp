#include "bed_drift.hpp"

#include <tuple>

#include "disturbance.hpp"

namespace cablenet::solve {
namespace {

using petsc::check;
using system::StaticRule;

/// The residual over the loads at which the equilibrium in still water is near enough.
constexpr double rough = 0.1;

/// An element's stiffness is, in the first stage, `first_ratio` times the sum of `over_tension` times its tension and
/// of a share of all drag.  Without the share, what lies without tension would have no stiffness at all.  Without the
/// tension, what hangs would stretch far, as it bears much more than drag.
constexpr double first_ratio = 3, over_tension = 10;

/// That share of all drag, and by how much the stiffness grows from stage to stage.  Where the first way did not
/// arrive, the others are tried.
struct Way {
  double share_of_drag, hardening;
};
constexpr Way ways[] = {{0.01, 4}, {0.1, 4}, {0.01, 2}};

/// The residual over the drag at which a descent ends, and a stage.
constexpr double goal_of_descent = 1e-3, goal_of_stage = 1e-3;

/// The most that a correction of Newton's method changes an element's chord, over its unstretched length.  No line
/// search shortens corrections here, and beyond this the predicted tensions mean nothing.
constexpr double most_turn = 1;

/// How often drag is taken anew in a stage, and Newton's corrections at most.
constexpr int most_drags = 3, most_corrections = 8, most_last_corrections = 40;

}   // namespace

BedDrift::BedDrift(Descent& descent, StaticForces& forces, StaticNewton& newton, StaticProgress& progress,
                   bool never_pushes)
    : descent_(descent),
      forces_(forces),
      newton_(newton),
      progress_(progress),
      rule_{.kind = StaticRule::Kind::descent, .never_pushes = never_pushes},
      hardest_(descent.largest_stiffness()),
      start_(descent.make_vector()) {}

bool BedDrift::find(Vec x) {
  forces_.still(true);
  descent_.soften(x);
  const bool is_near = descent_.go_on(x, rough);
  forces_.still(false);
  if (!is_near) return false;
  forces_.hold_drag(x);
  std::tie(drag_sum_, drag_norm_) = forces_.measure_drag();
  if (drag_sum_ == 0) return arrive(x);
  const system::Vector still = descent_.make_vector();
  check(VecCopy(x, still));
  for (const auto& [share_of_drag, hardening] : ways) {
    check(VecCopy(still, x));
    harden_in_stages(x, share_of_drag * drag_sum_, hardening);
    if (arrive(x)) return true;
    if (progress_.is_over()) break;
  }
  return false;
}

bool BedDrift::arrive(Vec x) { return arrive(x, {0, most_last_corrections, false, true, most_turn}); }

void BedDrift::harden_in_stages(Vec x, double least, double hardening) {
  StaticRule softer = rule_;
  softer.softening = {.over_tension = over_tension, .least = least};
  for (double ratio = first_ratio; ratio * softer.softening.least < hardest_ && !progress_.is_over();
       ratio *= hardening) {
    softer.softening.ratio = ratio;
    forces_.soften(softer, x);
    // A shape may have a mirror image.  Without a disturbance, rounding would choose between them, and with it the
    // number of ranks.
    if (ratio == first_ratio) disturb(descent_.network(), x);
    settle(x, ratio == first_ratio);
  }
  forces_.harden(x);
}

/// In later stages the shape changes little, and Newton's method may arrive at once.
void BedDrift::settle(Vec x, bool is_first) {
  const StaticGoal goal{goal_of_stage * drag_norm_, most_corrections, false, true, most_turn};
  if (!is_first && arrive(x, goal)) return;
  for (int i = 0; i < most_drags; ++i) {
    forces_.hold_drag(x);
    descent_.settle_held(x, goal_of_descent * drag_norm_);
    if (arrive(x, goal)) return;
  }
}

bool BedDrift::arrive(Vec x, const StaticGoal& goal) {
  forces_.let_drag_follow();
  check(VecCopy(x, start_));
  newton_.measure_loads(x);
  if (newton_.settle(x, rule_, goal)) return true;
  check(VecCopy(start_, x));
  return false;
}

}   // namespace cablenet::solve
