#pragma once
#include "cablenet/base/linear_algebra.hpp"

/// The data of cables.  cable.hpp and cable_in_water.hpp compute the forces on them.
namespace cablenet::elements {

/// The material of a cable.
struct CableMaterial {
  double axial_stiffness;   ///< EA [N], > 0
  double axial_damping;     ///< force per strain rate [N s], >= 0; includes Rayleigh's stiffness part, gamma EA
  double mass_per_length;   ///< of unstretched cable [kg/m], > 0
  double mass_damping;      ///< Rayleigh's mass part, beta [1/s], >= 0
  bool tension_only;        ///< a slack element (l < L) carries no force, damping included
};

/// The properties of a cable on which the forces of water depend.  cable_in_water.hpp defines the symbols.
struct CableInWater {
  double displaced;         ///< rho A [kg/m]
  double added;             ///< rho A Ca [kg/m]
  double normal_drag;       ///< 1/2 rho Cdn d [kg/m^2]
  double tangential_drag;   ///< 1/2 rho Cdt pi d [kg/m^2]
  double diameter;          ///< [m]
};

/// Position and velocity of node 2 relative to node 1.
struct Chord {
  Vector3 d;   ///< x2 - x1 [m], not zero
  Vector3 w;   ///< v2 - v1 [m/s]
};

/// The accelerations a + beta v of the two nodes [m/s^2], where beta is CableMaterial::mass_damping.
struct EndAccelerations {
  Vector3 at1;
  Vector3 at2;
};

/// The forces on the two nodes [N].
struct EndForces {
  Vector3 on1;
  Vector3 on2;
};

/// The exact tangent is the derivative of the force.  The secant one is the papers' K = EA/L e e^T, which neglects that
/// the chord turns.
enum class Tangent { exact, secant };

}   // namespace cablenet::elements
