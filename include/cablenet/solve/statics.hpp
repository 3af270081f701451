#pragma once
#include <petscksp.h>

#include <string>

#include "cablenet/solve/defaults.hpp"
#include "cablenet/solve/observers.hpp"
#include "cablenet/system/static_forces.hpp"

/// Equilibrium from any drawn shape.  Newton's method goes there at once from a shape that is near.  From others the
/// way is: cables as strings of one tension, linear at first so that the drawn shape is forgotten, then less and less
/// extensible; the cables as they are, with a tangent that turns by the tension that the last correction was to bring
/// about, so that what turning stretches does not stiffen it; then with their own tangent.  Where the tangent is
/// singular or has negative pivots, masses and drag over a pseudo-time 1/shift join in.  As the last resort the network
/// settles in time (relaxation.hpp).  Nothing whose tangent has negative pivots is taken, unless water flows past, with
/// which they tell nothing.
///
/// Source: strings after Schek, Comput. Methods Appl. Mech. Engng 3 (1974) 115 (force densities); the last correction's
/// tension after Magisano, Leonetti & Garcea, IJNME 109 (2017) 1237 (mixed integration point).
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
  std::string linear_solver() const { return describe(ksp_, linear_); }

private:
  struct Goal {
    double norm;      ///< of the residual [N]
    int iterations;   ///< at most
    bool searches;    ///< along the line
    bool may_shift = true;
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
  bool is_final(double norm, double previous) const;
  double reference() const;
  bool conclude(bool converged);

  system::Assembler& assembler_;
  double t_;
  Vector3 velocity_;
  system::StaticForces forces_;
  bool is_in_flow_;
  system::ForceScales scales_;
  system::TangentMatrix tangent_;
  KrylovSolver ksp_;
  LinearSolver linear_;
  system::Vector x_, drawn_, r_, step_, trial_;
  double steadiness_ = 1;
  double shift_ = 0;        ///< [1/s]
  double load_ = 0;         ///< 2-norm of the loads on nodes [N]
  double total_load_ = 0;   ///< sum of their components' absolute values [N]
  double furthest_drawn_ = 0;
  double furthest_ = 0;   ///< largest coordinate [m]
  double largest_load_ = 0, imbalance_ = 0;
  int iterations_ = 0;
  long negative_pivots_ = 0;
  bool monitors_ = false;
  std::string failure_;
};

}   // namespace cablenet::solve
