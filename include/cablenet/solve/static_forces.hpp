#pragma once
#include <array>
#include <utility>
#include <vector>

#include "cablenet/system/assembler.hpp"

namespace cablenet::solve {

/// The tensions at an iterate [N].
struct TensionRange {
  double least;     ///< the strongest compression, as a negative tension; 0 where there is none
  double largest;   ///< the largest absolute value
};

/// What keeps a tangent definite away from equilibrium.
struct Steadying {
  double pseudo_rate = 0;   ///< [1/s]
  double steadiness = 0;    ///< as in system::TangentRequest; none with system::StaticRule::exact
  /// What slips is taken as in environment::StickFriction::is_cautious.
  bool is_cautious = false;
};

/// The network's forces at an instant, in a frame in which the network is at rest.  There is no inertia, and no waves.
/// All member functions are collective unless they say otherwise.  Tests: tests/parallel/surroundings_test.cpp
class StaticForces {
public:
  /// @param velocity  of the frame [m/s]: the water and the bed move past it
  StaticForces(system::Assembler& assembler, double t, const Vector3& velocity);

  /// Some cable or bar may push.
  bool may_push() const;
  /// Water moves past the frame.  Not collective.
  bool is_in_flow() const;
  /// Stops the water, or lets it flow again.  Not collective.
  void still(bool stops) { is_stilled_ = stops; }
  /// Keeps the elements' directions at x.  system::StaticRule::ropes needs those of the iterate before.
  void keep(Vec x);
  /// Holds the drag: from here on it no longer depends on the shape.  It becomes share * drag at x + (1 - share) * what
  /// was held before.  The loads then have a potential, except those that turn bodies.
  void hold_drag(Vec x, double share = 1);
  /// From here on the drag follows the shape.
  void let_drag_follow() { holds_drag_ = false; }
  bool holds_drag() const { return holds_drag_; }
  /// Of the held drag on all nodes: the sum of its components' absolute values, and its 2-norm.  [N]
  std::pair<double, double> measure_drag();
  /// The 2-norm of the drag at x, which follows the shape afterwards.  [N]
  double drag(Vec x);

  /// Softens the elements by their tensions at x, as the rule's softening has it.
  void soften(const system::StaticRule& rule, Vec x);
  /// All are as stiff as they are.
  void harden(Vec x);

  /// Springs of friction hold what lies on the bed, from where it was laid (bed_lay.hpp) before it came to x.  Before
  /// this is called there is no such friction.
  void let_stick(Vec x);
  /// There is none again, until a run through time begins.
  void let_slide();
  bool sticks() const { return sticking_ != system::Sticking::absent; }
  /// Holds the pressure that limits friction, so that friction has a potential.  It becomes share * that at x +
  /// (1 - share) * what was held before.
  void hold_friction(Vec x, double share = 1);
  /// From here on the limit follows the pressure.
  void let_friction_follow();
  bool holds_friction() const { return sticking_ == system::Sticking::held; }

  /// r = internal forces - loads; with a matrix, also dr/dx + s^2 M + s dr/dv, s the pseudo-rate, published.  [N]
  /// @returns false on a rank where it is not defined
  bool residual(const system::StaticRule& rule, Vec x, Vec r, system::TangentMatrix* tangent,
                const Steadying& steadying);
  /// Of the internal forces and the bed.  [J]
  double potential(const system::StaticRule& rule, Vec x);
  /// What the loads alone leave: r without internal forces, and without the bed.
  void loads(Vec x, Vec r);
  TensionRange tensions(Vec x);
  /// The most that an element's chord changes from x to y, over its unstretched length.  Any rank's.
  double largest_turn(Vec x, Vec y);
  /// Of this rank's own elements, in their order.  [N]
  std::vector<double> element_tensions(Vec x);
  /// This rank's elements that push with more than `least` at x, by their numbers in the scene, and how much.  [N]
  std::vector<std::pair<int, double>> pushing(Vec x, double least);
  /// This rank's elements on the bed at x, by their numbers in the scene.  1: both ends lie on it.  0: one end does,
  /// and its vertical pull is less than the element's weight, so that a finer mesh would lie down there.
  std::vector<std::pair<int, double>> on_bed(Vec x);
  /// Makes x, moving with the frame, the network's start.
  void start_from(Vec x) { assembler_.start_from(t_, x, velocity_); }

private:
  system::Situation situation(system::InternalForce internal, const system::StaticRule& rule) const;
  bool is_still() const { return holds_drag_ || is_stilled_; }
  void raw_loads(Vec x, Vec r, bool is_still);
  double bed_softness(const system::StaticRule& rule, double stiffest) const;

  system::Assembler& assembler_;
  double t_;
  Vector3 velocity_;
  /// The largest stiffness of a node's contact over an element's EA/L, times EA: of cables, and of spots.  [N]
  std::array<double, 2> stiffest_bed_;
  double softest_cable_;   ///< the least EA [N]
  bool holds_drag_ = false, is_stilled_ = false;
  system::Sticking sticking_ = system::Sticking::absent;
  system::Vector v_, resting_, drag_, scratch_;
};

}   // namespace cablenet::solve
