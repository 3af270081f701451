#pragma once
#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/elements/cable_data.hpp"

/// A two-node cable element in nodal-position form.  The unknowns are the node positions themselves, so large rigid
/// motion needs no co-rotational frame.  The internal forces on nodes 1 and 2 are -f and +f with one vector f, so an
/// element's 6x6 tangent is [[K, -K], [-K, K]] with K = df/dd.
/// Source: Zhu, Int. J. Numer. Meth. Biomed. Engng 26 (2010) 692; two-ended force after Simo & Tarnow, ZAMP 43 (1992)
/// 757, and Kuhl & Crisfield, IJNME 45 (1999) 569.  Tests: tests/unit/cable_test.cpp
namespace cablenet::elements {

/// Derivatives of the force f by the chord d and by its rate w.
struct ForceTangent {
  Matrix3 d;   ///< [N/m]
  Matrix3 w;   ///< [N s/m]
};

/// T = EA (l/L - 1) + c l'/L, where c is axial_damping.  [N]  A tension_only element never pushes: its tension is 0
/// where it is slack (l < L), and where this formula is negative.
/// @param L unstretched length [m], > 0
double cable_tension(const CableMaterial&, double L, const Chord&);

/// f = T e, e = d/l.  [N]
Vector3 cable_force(const CableMaterial&, double L, const Chord&);

/// The derivatives of cable_force.
ForceTangent cable_force_tangent(const CableMaterial&, double L, const Chord&, Tangent);

/// A step of the energy-momentum scheme from chord d0 to chord d1.
struct ChordStep {
  Vector3 d0;       ///< x2 - x1 at the step's start [m]
  Vector3 d1;       ///< at its end [m]
  double dt;        ///< [s], > 0
  double xi;        ///< axial dissipation, 0 .. 1/2
  double due = 0;   ///< r times the change of p in the step before, r = min(1, dt/dt before) [m]
};

/// f = T (d0 + d1)/(l0 + l1),  T = theta (EA/L ((p0 + p1)/2 + xi (p1 - p0 - due)) + c/L (l1 - l0)/dt),
/// theta = (p1 - p0)/(l1 - l0).  [N]
/// The elongation p carries the tension.  It is l - L, or 0 where a tension_only element is slack.
/// Without the terms in xi and c, the work f . (d1 - d0) is exactly the change of the strain energy EA/L p^2/2.  (T is
/// then the discrete gradient of that energy.)  The term in xi resists a growth of p other than
/// `due`, which the steps before let expect (next_due()).  It never raises the sum of all energy and of
/// xi/(2 + 2 a) EA/L due^2, where a is that of next_due().  In each step it takes energy of third order in dt from a
/// smooth motion.
/// A tension_only element never pushes: T is 0 where the formula is negative.
Vector3 energy_momentum_force(const CableMaterial&, double L, const ChordStep&);

/// The derivative of energy_momentum_force by d1, an unsymmetric matrix.  [N/m]
Matrix3 energy_momentum_tangent(const CableMaterial&, double L, const ChordStep&, Tangent);

/// EA L strain^2 / 2, or 0 where the element is slack and tension_only.  [J]
double cable_strain_energy(const CableMaterial&, double L, const Vector3& d);

/// v^T M v / 2 with the consistent mass M = rho A L/6 [[2, 1], [1, 2]] x I3.  [J]
double cable_kinetic_energy(const CableMaterial&, double L, const Vector3& v1, const Vector3& v2);

/// M q with q = a + beta v at the two nodes and the mass M of cable_kinetic_energy.  [N]
inline EndForces cable_inertia(const CableMaterial& m, double L, const Vector3& q1, const Vector3& q2) {
  const double sixth = m.mass_per_length * L / 6;
  return {sixth * (2 * q1 + q2), sixth * (q1 + 2 * q2)};
}

/// The forces that the neighbours exert on the two ends when the element moves as it does:
/// M (a + beta v) + (-f, +f), less half the weight at each end.  [N]
/// @param gravity acceleration [m/s^2] along -z
EndForces cable_end_forces(const CableMaterial&, double L, double gravity, const Chord&, const EndAccelerations& q);

}   // namespace cablenet::elements
