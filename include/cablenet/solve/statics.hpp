#pragma once
#include <petscksp.h>

#include <string>

#include "cablenet/solve/linear_solver.hpp"
#include "cablenet/solve/observers.hpp"
#include "cablenet/solve/static_forces.hpp"

/// Equilibrium from any drawn shape.
///
/// Newton's method on the cables as they are comes first.  It finds the equilibrium from a shape that is near it.  From
/// other shapes the way has three stages, each of which starts from where the one before it ended:
///   1. Strings.  Each cable pulls with (l/L)^p times one tension.  For p = 1 this is linear, so that the drawn shape
///      does not matter.  With larger p the strings extend less and less.
///   2. Ropes.  The forces are those of the cables as they are.  But the tangent's geometric stiffness, tension over
///      length, takes another tension: the one that the linear equations predicted for the last correction.  An element
///      that turns far in a correction is stretched by it, and the tension from that stretch would make it far too
///      stiff.
///   3. Newton's method on the cables as they are.
/// Where a tangent is singular or has negative pivots, masses and drag are added as in a step of pseudo-time 1/shift.
/// The last resort is to let the network settle in time (relaxation.hpp).
///
/// An equilibrium whose tangent has negative pivots is not stable, and is taken only from the first, direct way.
/// Where water flows past, the tangent is unsymmetric; its pivots then tell nothing of stability and are not looked at.
///
/// Sources: for the strings Schek, Comput. Methods Appl. Mech. Engng 3 (1974) 115 (force densities); for the ropes'
/// tension Magisano, Leonetti & Garcea, IJNME 109 (2017) 1237 (mixed integration point).
///
/// Tests: tests/verification/statics.py, published_statics.py, static_networks.py, steady_tow.py
namespace cablenet::solve {

using KrylovSolver = petsc::Handle<KSP, KSPDestroy>;

/// All member functions are collective.
class Statics {
public:
  /// From the network's start.  Reads the options database (-ksp_*, -pc_*, -cable_statics_monitor).
  /// @param velocity  of the frame in which nothing moves [m/s]
  Statics(system::Assembler& assembler, double t, const Vector3& velocity);

  /// @returns whether an equilibrium was found; position() is then it, otherwise the best that was
  bool solve();
  Vec position() const { return x_; }
  /// Makes position() the network's start.
  void make_start() { forces_.start_from(x_); }
  /// Largest unbalanced force on a node over the largest load on one.
  double imbalance() const { return imbalance_; }
  double largest_load() const { return largest_load_; }   ///< [N]
  int iterations() const { return iterations_; }
  /// It would be left after a disturbance: some pivots of the tangent are negative.
  bool is_unstable() const { return negative_pivots_ > 0; }
  const std::string& failure() const { return failure_; }
  FailedPart failed_part();
  std::string linear_solver() const { return linear_.describe(); }

private:
  struct Goal {
    double norm;             ///< of the residual, at which to end; 0: as far as rounding allows [N]
    int iterations;          ///< at most
    bool searches;           ///< along the line of each correction
    bool may_shift = true;   ///< where the tangent is not definite
  };

  bool is_taut();
  bool is_near_drawn();
  bool go_directly();
  bool go_by_strings();
  bool go_in_time();
  bool settle_as_they_are(int iterations);
  bool settle(system::StaticRule rule, const Goal& goal);
  bool correct(const system::StaticRule& rule, bool may_shift);
  double search(const system::StaticRule& rule, double now, bool searches);
  system::StaticRule ropes() const;
  double least_tension() const;
  void measure_loads();
  double evaluate(const system::StaticRule& rule, Vec x, bool with_tangent);
  bool factor_and_solve();
  void count_negative_pivots();
  bool is_final(double norm, double previous) const;
  double reference() const;
  bool conclude(bool converged);

  system::Assembler& assembler_;
  double t_;
  Vector3 velocity_;
  StaticForces forces_;
  bool is_in_flow_;
  system::ForceScales scales_;
  system::TangentMatrix tangent_;
  KrylovSolver ksp_;
  LinearSolver linear_;
  system::Vector x_, drawn_, r_, step_, trial_;
  double steadiness_ = 1;
  double shift_ = 0;                      ///< [1/s]
  double load_ = 0;                       ///< 2-norm of the loads on nodes [N]
  double total_load_ = 0;                 ///< sum of their components' absolute values [N]
  double largest_drawn_coordinate_ = 0;   ///< [m]
  double largest_coordinate_ = 0;         ///< which rounding depends on [m]
  double largest_load_ = 0, imbalance_ = 0;
  int iterations_ = 0;
  long negative_pivots_ = 0;
  bool monitors_ = false;
  std::string failure_;
};

}   // namespace cablenet::solve
