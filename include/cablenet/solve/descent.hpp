#pragma once
#include <petscksp.h>

#include "cablenet/solve/linear_solver.hpp"
#include "cablenet/solve/static_forces.hpp"
#include "cablenet/solve/static_progress.hpp"

/// Goes down in energy to an equilibrium.  Under dead loads and on a bed without friction, cables that do not push have
/// a convex energy.  A method that always goes down cannot miss its least value, whatever was drawn.
///
/// A correction is Newton's with a positive tangent: what is slack or pushes turns nothing, and strings of the tension
/// lambda T hold the nodes together.  It is shortened until the energy falls by Armijo's rule.  lambda falls after
/// whole corrections and grows after short ones.  The energy is that of the cables and of the bed, and the work of the
/// loads on the way.
///
/// Cables are soft at first, and so is the bed.  They become stiffer in stages: a stiff cable that turns far is
/// stretched so much that corrections would have to be short.
///
/// Drag has no potential.  It is held as it is at a shape until the descent has ended, and is then taken anew.
///
/// Source of the tangent's tension: Magisano, Leonetti & Garcea, IJNME 109 (2017) 1237.
/// Tests: tests/verification/slack_moorings.py, static_scenes.py
namespace cablenet::solve {

/// All member functions are collective.
class Descent {
public:
  /// What it works on, which must outlive it.
  struct Parts {
    system::Assembler& assembler;
    StaticForces& forces;
    system::TangentMatrix& tangent;
    KSP ksp;
    LinearSolver& linear;
    StaticProgress& progress;
  };
  /// @param never_pushes  all cables are tension_only
  Descent(const Parts& parts, bool never_pushes);
  /// Afterwards drag and friction follow the shape.
  ~Descent() { let_follow(); }
  Descent(const Descent&) = delete;
  Descent& operator=(const Descent&) = delete;

  /// Goes near the equilibrium by soft cables.
  void soften(Vec x);
  /// Goes down with the true stiffness of the cables.  It ends where the residual is at most `goal` times the loads.
  /// @returns whether it got there
  bool go_on(Vec x, double goal);
  /// Goes down while the drag is held.  It ends where the residual is at most `goal` [N], or where rounding hides
  /// whether the energy falls.
  void settle_held(Vec x, double goal);
  double largest_stiffness() const;   ///< EA [N]
  const partition::LocalNetwork& network() const { return parts_.assembler.network(); }
  system::Vector make_vector() const { return parts_.assembler.make_vector(); }

private:
  /// Of the energy along a correction.  [J]
  struct Slope {
    double all, loads;
  };

  void let_follow() {
    parts_.forces.let_drag_follow();
    parts_.forces.let_friction_follow();
  }
  void measure_loads(Vec x);
  bool follow(Vec x, double goal);
  bool settle(Vec x, double goal, int most);
  bool correct(Vec x, Slope& slope);
  double search(Vec x, const Slope& slope, double now);
  bool is_lower(const Slope& slope, double share, double now, double then, double potential);
  double evaluate(Vec x, bool with_tangent);
  double holding() const;

  Parts parts_;
  system::StaticRule rule_;
  system::Vector r_, loads_, step_, trial_;
  double load_ = 0;         ///< 2-norm of the loads on nodes [N]
  double total_load_ = 0;   ///< sum of their components' absolute values [N]
  double lambda_ = 1;
  double potential_ = 0;     ///< at the iterate [J]
  bool is_hidden_ = false;   ///< Rounding hides by how much the energy falls.
  double end_slope_ = 0;     ///< of the energy along the correction, where the last trial ended [J]
};

}   // namespace cablenet::solve
