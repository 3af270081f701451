#pragma once
#include "cablenet/base/linear_algebra.hpp"

/// Cables as data; what acts on them is in cable.hpp and cable_in_water.hpp.
namespace cablenet::elements {

/// What a cable is made of.
struct CableMaterial {
  double axial_stiffness;   ///< EA [N], > 0
  double axial_damping;     ///< force per strain rate [N s], >= 0; Rayleigh's stiffness part (gamma EA) included
  double mass_per_length;   ///< of unstretched cable [kg/m], > 0
  double mass_damping;      ///< Rayleigh's mass part, beta [1/s], >= 0
  bool tension_only;        ///< a slack element (l < L) carries no force, damping included
};

/// What the water needs to know of that; the symbols are those of cable_in_water.hpp.
struct CableInWater {
  double displaced;         ///< rho A [kg/m]
  double added;             ///< rho A Ca [kg/m]
  double normal_drag;       ///< 1/2 rho Cdn d [kg/m^2]
  double tangential_drag;   ///< 1/2 rho Cdt pi d [kg/m^2]
  double diameter;          ///< [m]
};

/// Node 2 relative to node 1.
struct Chord {
  Vector3 d;   ///< x2 - x1 [m], not zero
  Vector3 w;   ///< v2 - v1 [m/s]
};

/// a + beta v at the two nodes [m/s^2].
struct EndAccelerations {
  Vector3 at1;
  Vector3 at2;
};

/// On the two nodes [N].
struct EndForces {
  Vector3 on1;
  Vector3 on2;
};

/// exact: consistent with the force; secant: the papers' K = EA/L e e^T, which leaves the turning of the chord out.
enum class Tangent { exact, secant };

}   // namespace cablenet::elements
