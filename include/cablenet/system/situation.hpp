#pragma once
#include <limits>
#include <optional>

#include "cablenet/base/index.hpp"
#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/base/shift.hpp"
#include "cablenet/elements/static_rule.hpp"
#include "cablenet/system/stage.hpp"

namespace cablenet::system {

class TangentMatrix;
using elements::StaticRule;

/// What takes the place of the cables' internal force.
enum class InternalForce {
  of_step,      ///< as the scheme has it over the step
  of_instant,   ///< at the stage's positions and velocities
  of_statics,   ///< as Situation::rule has it
  none          ///< no force; this leaves the mass matrix
};

/// Where nodes hold the bed, if they do.  [m]
using GripPlaces = Table<LocalNode, std::optional<Vector3>>;

/// How the springs of friction on the bed pull (environment::StickFriction).
enum class Sticking {
  as_it_is,   ///< up to what the bed's pressure lets them
  absent,     ///< not at all
  measured,   ///< as it is; Assembler::begin notes the pressures
  held        ///< up to what the noted pressures let them, wherever nodes are
};

/// Under which an evaluation is made.  The default is a step of the scene as it is.
struct Situation {
  Stage stage;
  InternalForce internal = InternalForce::of_step;
  StaticRule rule{};   ///< of InternalForce::of_statics
  /// Prescribed nodes stand where they are at stage.t, and move at this velocity [m/s].  Without it they move as the
  /// scene says.
  std::optional<Vector3> frame{};
  bool is_calm = false;    ///< The water has no waves.
  bool is_still = false;   ///< The water has neither waves nor current.
  /// The bed is so many times softer, its smoothing so many times wider: for cables, and for points and bodies.  0: no
  /// bed.
  double bed_softness = 1, spot_softness = 1;
  Sticking sticking = Sticking::as_it_is;
  double measured_share = 1;   ///< of what Sticking::measured notes; the rest is what was noted before
};

/// Which tension turns the chords in a tangent: the force's own, or the one that the last tangent of the running solve
/// lets expect (elements::Turning).
struct TurningRule {
  bool is_predicted = false;
  bool is_first = true;                                      ///< of the solve
  double least = -std::numeric_limits<double>::infinity();   ///< [N]

  /// The tangent is to lead out of a cycle.
  bool is_cautious() const { return least >= 0; }
};

/// Where a tangent goes, and what it is by.
struct TangentRequest {
  TangentMatrix& matrix;
  Shift shift;
  bool holds_water = false;   ///< Water's loads do not follow positions.
  /// A stiffness of bodies against turning, over the torque that their forces can have.  With it, water's loads on
  /// bodies do not follow attitudes.
  double steadiness = 0;
  TurningRule turning{};
};

}   // namespace cablenet::system
