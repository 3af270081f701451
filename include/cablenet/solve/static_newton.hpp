#pragma once
#include <petscksp.h>

#include <limits>
#include <string>

#include "cablenet/solve/linear_solver.hpp"
#include "cablenet/solve/static_forces.hpp"
#include "cablenet/solve/static_progress.hpp"

/// Newton's method for equilibria, on the cables as they are or on what a rule puts in their place.  Where a tangent is
/// singular or has negative pivots, masses and drag are added as in a step of pseudo-time 1/shift.
/// Where water flows past, the tangent is unsymmetric; stability is then that with the drag held.
/// Tests: tests/verification/statics.py, static_choices.py
namespace cablenet::solve {

using KrylovSolver = petsc::Handle<KSP, KSPDestroy>;

/// When an iteration ends.
struct StaticGoal {
  double norm;             ///< of the residual, at which to end; 0: as far as rounding allows [N]
  int iterations;          ///< at most
  bool searches;           ///< along the line of each correction
  bool may_shift = true;   ///< where the tangent is not definite
  /// The most that a correction changes an element's chord, over its unstretched length.
  double most_turn = std::numeric_limits<double>::infinity();
};

/// All member functions are collective.
class StaticNewton {
public:
  /// Reads the options database (-ksp_*, -pc_*).
  /// @param drawn  the shape by which forces and coordinates are measured
  StaticNewton(system::Assembler& assembler, StaticForces& forces, StaticProgress& progress, double t, Vec drawn);

  /// Iterates from x.  Without a norm in the goal it measures the loads there.  @returns whether the goal was reached
  bool settle(Vec x, system::StaticRule rule, const StaticGoal& goal);
  /// As they are; and then looks whether the shape is stable.
  bool settle_as_they_are(Vec x, int iterations);
  /// Ropes whose turning takes the tension that the last correction has predicted.
  system::StaticRule ropes() const;
  double least_tension() const;

  /// What residuals are measured by from here on: the loads at x, or the cables' pull where there are none.
  void measure_loads(Vec x);
  double reference() const { return load_ > 0 ? load_ : scales_.load; }   ///< [N]
  double load() const { return load_; }                                   ///< 2-norm of the loads on nodes [N]
  double total_load() const { return total_load_; }   ///< sum of their components' absolute values [N]
  const system::ForceScales& scales() const { return scales_; }
  /// A residual [N], some times what rounding of positions makes, that passes as rounding.
  double rounding() const;

  /// At x.  The last correction had the tangent of the shape before it, and a shape that is drawn in equilibrium takes
  /// no correction.
  void count_negative_pivots(Vec x);
  bool is_unstable() const { return negative_pivots_ > 0; }

  /// The 2-norm of r, which becomes the residual at x.  Infinite where it is not defined.
  double evaluate(const system::StaticRule& rule, Vec x, bool with_tangent);
  Vec residual() const { return r_; }
  const std::string& failure() const { return failure_; }
  std::optional<PivotReport> pivots() const { return linear_.pivots(); }

  /// For other methods that share the linear solver.
  system::TangentMatrix& tangent() { return tangent_; }
  KSP ksp() const { return ksp_; }
  LinearSolver& linear() { return linear_; }
  const LinearSolver& linear() const { return linear_; }

private:
  bool correct(Vec x, const system::StaticRule& rule, bool may_shift);
  double search(Vec x, const system::StaticRule& rule, double now, const StaticGoal& goal);
  double share_of_turn(Vec x, double most_turn);
  bool factor_and_solve();
  bool is_final(double norm, double previous) const;

  system::Assembler& assembler_;
  StaticForces& forces_;
  StaticProgress& progress_;
  system::ForceScales scales_;
  system::TangentMatrix tangent_;
  KrylovSolver ksp_;
  LinearSolver linear_;
  system::Vector r_, step_, trial_;
  double steadiness_ = 1;
  bool is_cautious_ = false;
  double shift_ = 0;                      ///< [1/s]
  double load_ = 0, total_load_ = 0;      ///< [N]
  double largest_load_ = 0;               ///< on a node, so far [N]
  double largest_drawn_coordinate_ = 0;   ///< [m]
  double largest_coordinate_ = 0;         ///< which rounding depends on [m]
  long negative_pivots_ = 0;
  std::string failure_;
};

}   // namespace cablenet::solve
