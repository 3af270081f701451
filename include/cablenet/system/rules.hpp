#pragma once
#include "cablenet/elements/cable_data.hpp"
#include "cablenet/scene/scene.hpp"

namespace cablenet::system {

/// How the internal force is taken over a step.
struct ForceRule {
  scene::Scheme scheme = scene::Scheme::energy_momentum;
  double axial_dissipation = 0;   ///< xi, energy_momentum only
  elements::Tangent tangent = elements::Tangent::exact;
};

/// What stands in for the internal force on the way to equilibrium.
struct StaticRule {
  enum class Kind {
    strings,   ///< string_tension (l/L)^exponent: convex; linear at exponent 1, so that the drawn shape does not
               ///< matter, and nearly inextensible at large ones.  Water's loads are held in the tangent at exponent 1
    ropes,     ///< as they are; the tangent turns by the tension that the last correction was to bring about, or by the
               ///< strings' where string_tension is given, and by least_tension at least
    exact      ///< as they are, with their own tangent
  } kind;
  double exponent = 1;
  double string_tension = 0;   ///< [N]
  double least_tension = 0;    ///< [N]
};

/// Root-sum-squares over all elements and loads: what Newton's tolerances are scaled by.
struct ForceScales {
  double load;        ///< tension, weight, m v^2/L at the start [N]
  double stiffness;   ///< 2 EA/L [N/m]
  double mass;        ///< [kg]
  double bed;         ///< |level| times the stiffness of contact [N]
  /// What rounding of positions does to the residual's 2-norm: eps (|x| (stiffness + shift_a mass) + bed).  [N]
  /// @param furthest largest coordinate [m]
  double rounding(double furthest, double shift_a) const;
};

/// A stage of a step from t to t + dt: x_a = x + alpha_f (x1 - x), v_a alike.
struct Stage {
  double t;
  double dt;
  double alpha_f;
  bool operator==(const Stage&) const = default;
};

class TangentMatrix;

/// Where a tangent goes, and how v and a follow x in an implicit step: dv/dx [1/s], da/dx [1/s^2].
struct TangentRequest {
  TangentMatrix& matrix;
  double shift_v;
  double shift_a;
  double shift_x = 1;         ///< 0: of the accelerations alone
  bool holds_water = false;   ///< its loads do not follow positions
  double steadiness = 0;      ///< stiffness of bodies against turning over what their forces can turn with; with it,
                              ///< water's loads on them do not follow attitudes
};

}   // namespace cablenet::system
