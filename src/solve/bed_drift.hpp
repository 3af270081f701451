#pragma once
#include "cablenet/solve/descent.hpp"
#include "cablenet/solve/static_newton.hpp"

namespace cablenet::solve {

/// Finds the equilibrium of cables that lie slack on a bed without friction, in a current.  Weight and the bed alone
/// let them lie anywhere.  Drag decides, though it is thousands of times smaller, and it moves them far.
///
/// The equilibrium in still water comes first.  Then each element is softened until its stiffness is a few times its
/// tension, or a few times the tension that drag can make.  So soft cables go where the drag takes them: as with all
/// cables, an element that turns far is stretched, and its stiffness over its tension is what shortens corrections.
/// From there they become as stiff as they are, in stages.
///
/// In each stage the drag is held and taken anew until Newton's method arrives.  Newton's method has the drag's
/// derivative.  It takes whole corrections.  Its tangent has the tension that the last correction predicted
/// (StaticRule::Kind::descent).
///
/// Tests: tests/verification/slack_moorings.py
/// All member functions are collective.
class BedDrift {
public:
  /// All must outlive it.
  BedDrift(Descent& descent, StaticForces& forces, StaticNewton& newton, StaticProgress& progress, bool never_pushes);

  /// Goes from x to the equilibrium.  @returns whether it got there; otherwise x is where the last attempt ended
  bool find(Vec x);

private:
  bool arrive(Vec x);
  /// @param least  of an element's stiffness in the first stage, over the first ratio [N]
  void harden_in_stages(Vec x, double least, double hardening);
  void settle(Vec x, bool is_first);
  bool arrive(Vec x, const StaticGoal& goal);

  Descent& descent_;
  StaticForces& forces_;
  StaticNewton& newton_;
  StaticProgress& progress_;
  system::StaticRule rule_;
  double hardest_;         ///< the largest EA [N]
  double drag_sum_ = 0;    ///< of its components' absolute values [N]
  double drag_norm_ = 0;   ///< [N]
  system::Vector start_;
};

}   // namespace cablenet::solve
