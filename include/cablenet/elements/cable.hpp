#pragma once
#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/elements/cable_data.hpp"

/// Two-node cable element in nodal-position form: the unknowns are the node positions themselves, so large rigid motion
/// needs no co-rotational frame.  The internal force on nodes 1, 2 is (-f, +f) with one vector f, so that an element's
/// 6x6 tangent is [[K, -K], [-K, K]] with K = df/dd.
/// Source: Zhu, Int. J. Numer. Meth. Biomed. Engng 26 (2010) 692; two-ended force after Simo & Tarnow, ZAMP 43 (1992)
/// 757, and Kuhl & Crisfield, IJNME 45 (1999) 569.  Tests: tests/unit/cable_test.cpp
namespace cablenet::elements {

/// Derivatives of the force by the chord.
struct ForceTangent {
  Matrix3 d;   ///< [N/m]
  Matrix3 w;   ///< [N s/m]
};

/// T = EA (l/L - 1) + c l'/L,  0 when slack and tension_only.  [N]
/// @param L unstretched length [m], > 0
double cable_tension(const CableMaterial&, double L, const Chord&);

/// f = T e, e = d/l.  [N]
Vector3 cable_force(const CableMaterial&, double L, const Chord&);

/// The tangent of cable_force.
ForceTangent cable_force_tangent(const CableMaterial&, double L, const Chord&, Tangent);

/// A step from chord d0 to d1 in the energy-momentum scheme.
struct ChordStep {
  Vector3 d0;   ///< x2 - x1 at the step's start [m]
  Vector3 d1;   ///< at its end [m]
  double dt;    ///< [s], > 0
  double xi;    ///< axial dissipation, 0 .. 1/2
};

/// f = T (d0 + d1)/(l0 + l1),  T = EA [(1/2 - xi) strain0 + (1/2 + xi) strain1] + c (strain1 - strain0)/dt.  [N]
/// Then f . (d1 - d0) = T (l1 - l0): exactly the change of strain energy plus EA L xi (strain1 - strain0)^2 plus
/// damping. A tension_only element that goes slack or taut within the step gets the discrete gradient of its strain
/// energy, so that the same holds.
Vector3 energy_momentum_force(const CableMaterial&, double L, const ChordStep&);

/// d f / d d1 of energy_momentum_force; unsymmetric.  [N/m]
Matrix3 energy_momentum_tangent(const CableMaterial&, double L, const ChordStep&, Tangent);

/// EA L strain^2 / 2,  0 when slack and tension_only.  [J]
double cable_strain_energy(const CableMaterial&, double L, const Vector3& d);

/// v^T M v / 2 with the consistent mass M = rho A L/6 [[2, 1], [1, 2]] x I3.  [J]
double cable_kinetic_energy(const CableMaterial&, double L, const Vector3& v1, const Vector3& v2);

/// M q, q = a + beta v at the two nodes; M as in cable_kinetic_energy.  [N]
inline EndForces cable_inertia(const CableMaterial& m, double L, const Vector3& q1, const Vector3& q2) {
  const double sixth = m.mass_per_length * L / 6;
  return {sixth * (2 * q1 + q2), sixth * (q1 + 2 * q2)};
}

/// What the neighbours must pull with at the two ends for the element to move as it does:
/// M (a + beta v) + (-f, +f) - weight/2 each.  [N]
/// @param gravity acceleration [m/s^2] along -z
EndForces cable_end_forces(const CableMaterial&, double L, double gravity, const Chord&, const EndAccelerations& q);

}   // namespace cablenet::elements
