#pragma once
#include "cablenet/solve/descent.hpp"
#include "cablenet/solve/observers.hpp"
#include "cablenet/solve/static_newton.hpp"

/// Equilibrium from any drawn shape.
///
/// Newton's method on the cables as they are comes first.  It finds the equilibrium from a shape that is near it.  From
/// other shapes it is found by going down in energy (descent.hpp): first as if no cable could push, and from there as
/// the cables are, where some push.  Newton's method then takes away the rest.  What lies slack on a bed without
/// friction in a current goes down with soft cables (src/solve/bed_drift.hpp).
///
/// In a flow without a bed, drag rules, and an energy is of little use.  There, and where the descent fails, the way
/// has three stages, each of which starts from where the one before it ended:
///   1. Strings.  Each cable pulls with (l/L)^p times one tension.  For p = 1 this is linear, so that the drawn shape
///      does not matter.  With larger p the strings extend less and less.
///   2. Ropes.  The forces are those of the cables as they are.  But the tangent's geometric stiffness, tension over
///      length, takes another tension: the one that the linear equations predicted for the last correction.  An element
///      that turns far in a correction is stretched by it, and the tension from that stretch would make it far too
///      stiff.
///   3. Newton's method on the cables as they are.
/// The last resort is to let the network settle in time (relaxation.hpp).
///
/// An equilibrium whose tangent has negative pivots is not stable.  It is left towards lower energy, and taken only
/// where it is drawn, or where there is no other.
///
/// Sources: for the strings Schek, Comput. Methods Appl. Mech. Engng 3 (1974) 115 (force densities); for the ropes'
/// tension Magisano, Leonetti & Garcea, IJNME 109 (2017) 1237 (mixed integration point).
///
/// Tests: tests/verification/statics.py, published_statics.py, static_networks.py, slack_moorings.py, steady_tow.py
namespace cablenet::solve {

/// All member functions are collective.
class Statics {
public:
  /// From the network's start.  Reads the options database (-ksp_*, -pc_*, -cable_statics_*).
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
  /// What is left is more than it should be, but no more than rounding of positions makes.
  bool ends_by_rounding() const { return ends_by_rounding_; }
  int iterations() const { return progress_.iterations(); }
  /// It would be left after a disturbance: some pivots of the tangent are negative.
  bool is_unstable() const { return newton_.is_unstable(); }
  /// This rank's elements that push, by their numbers in the scene, and how much.  [N]
  std::vector<std::pair<int, double>> pushing();
  /// As StaticForces::on_bed().
  std::vector<std::pair<int, double>> on_bed() { return forces_.on_bed(x_); }
  const std::string& failure() const { return failure_; }
  /// If no cable could push, there would be an equilibrium.  It was found where solve() found none.
  bool is_there_without_pushing() const { return is_there_without_pushing_; }
  /// Friction that holds was left out: with it no equilibrium was found, or only one that pushes or is not stable.
  bool leaves_friction_out() const { return leaves_friction_out_; }
  /// Cables lie on a bed without friction, and their drag is no larger than the unbalanced force.  The current then
  /// does not tell where they lie.
  bool is_drag_lost() const { return is_drag_lost_; }
  FailedPart failed_part();
  std::string linear_solver() const { return newton_.linear().describe(); }

private:
  bool find();
  bool is_taut();
  double slight_push();   ///< [N]
  bool is_near_drawn();
  bool go_down();
  bool let_push(bool is_equilibrium);
  bool drifts() const;
  bool descend(bool never_pushes);
  bool descend(Descent& descent, bool never_pushes);
  Descent::Parts descent_parts();
  bool sticks() const;
  bool find_rubbing();
  bool rub(bool was_taut);
  bool rub_from_here(bool never_pushes);
  bool is_taut_enough();
  bool leave_saddle();
  bool go_by_strings();
  bool go_in_time();
  bool conclude(bool converged);

  system::Assembler& assembler_;
  double t_;
  Vector3 velocity_;
  StaticForces forces_;
  StaticProgress progress_;
  bool may_push_;   ///< some cable
  system::Vector x_, drawn_, trial_;
  StaticNewton newton_;
  double largest_load_ = 0, imbalance_ = 0;
  bool ends_by_rounding_ = false, is_there_without_pushing_ = false, leaves_friction_out_ = false;
  bool is_drag_lost_ = false;
  PetscReal largest_drawn_load_ = 0;   ///< on a node [N]
  std::string failure_;
};

}   // namespace cablenet::solve
