#pragma once
#include "cablenet/system/assembler.hpp"

namespace cablenet::solve {

/// The tensions at an iterate [N].
struct TensionRange {
  double least;     ///< of elements that carry compression
  double largest;   ///< absolute
};

/// What keeps a tangent definite away from equilibrium.
struct Steadying {
  double pseudo_rate = 0;   ///< [1/s]
  double steadiness = 0;    ///< as in system::TangentRequest; none with system::StaticRule::exact
};

/// The network's forces at an instant, in a frame in which nothing moves: without inertia and waves.
/// All member functions are collective unless they say otherwise.  Tests: tests/parallel/surroundings_test.cpp
class StaticForces {
public:
  /// @param velocity  of the frame [m/s]: the water and the bed move past it
  StaticForces(system::Assembler& assembler, double t, const Vector3& velocity);

  /// The one velocity that all prescribed nodes have in the first fifth of the window.  Otherwise each component is the
  /// middle of what occurs in the window, or zero where that varies by more than a quarter of the middle: heave, a
  /// start from rest, a point that stays.  [m/s]
  /// @param window  from t on [s]
  static Vector3 frame_velocity(const system::Assembler& assembler, double t, double window);

  /// Water moves past the frame.  Not collective.
  bool is_in_flow() const;
  /// Keeps an iterate's directions, which system::StaticRule::ropes needs of the last one.
  void keep(Vec x);
  /// r = internal forces - loads; with a matrix, also dr/dx + s^2 M + s dr/dv, s the pseudo-rate, published.  [N]
  /// @returns false on a rank where it is not defined
  bool residual(const system::StaticRule& rule, Vec x, Vec r, system::TangentMatrix* tangent,
                const Steadying& steadying);
  /// What the loads alone leave: r without internal forces, and without the bed.
  void loads(Vec x, Vec r);
  TensionRange tensions(Vec x);
  /// Makes x, moving with the frame, the network's start.
  void start_from(Vec x) { assembler_.start_from(t_, x, velocity_); }

private:
  system::Situation situation(system::InternalForce internal, const system::StaticRule& rule) const;
  double bed_softness(const system::StaticRule& rule) const;

  system::Assembler& assembler_;
  double t_;
  Vector3 velocity_;
  double stiffest_bed_;    ///< the largest of contact over an element, in stiffness, times EA [N]
  double softest_cable_;   ///< the least EA [N]
  system::Vector v_, resting_;
};

}   // namespace cablenet::solve
