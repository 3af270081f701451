#include "cablenet/elements/cable.hpp"

#include "cablenet/elements/energy_momentum_step.hpp"

namespace cablenet::elements {

double cable_tension(const CableMaterial& m, double L, const Chord& c) {
  return instant_tension<true>(m, L, stretch(c.d), c.w);
}

Vector3 cable_force(const CableMaterial& m, double L, const Chord& c) {
  return cable_tension(m, L, c) / c.d.norm() * c.d;
}

ForceTangent cable_force_tangent(const CableMaterial& m, double L, const Chord& c, Tangent kind) {
  const double T = cable_tension(m, L, c);
  return instant_tangent<true>(m, L, stretch(c.d), c.w, T, T, kind);
}

Vector3 energy_momentum_force(const CableMaterial& m, double L, const ChordStep& s) {
  const Stretch s0 = stretch(s.d0), s1 = stretch(s.d1);
  return step_tension<true>(m, L, {s0.l, s1.l, s.dt, s.xi, s.due}).T * mean_direction(s0, s1);
}

Matrix3 energy_momentum_tangent(const CableMaterial& m, double L, const ChordStep& s, Tangent kind) {
  const Stretch s0 = stretch(s.d0), s1 = stretch(s.d1);
  const TensionSlope tension = step_tension<true>(m, L, {s0.l, s1.l, s.dt, s.xi, s.due});
  return energy_momentum_tangent(tension.slope, tension.T, s0, s1, kind);
}

double cable_strain_energy(const CableMaterial& m, double L, const Vector3& d) {
  const double strain = (d.norm() - L) / L;
  return carries<true>(m, strain) ? 0.5 * m.axial_stiffness * L * strain * strain : 0.0;
}

double cable_kinetic_energy(const CableMaterial& m, double L, const Vector3& v1, const Vector3& v2) {
  return m.mass_per_length * L / 6 * (v1.squaredNorm() + v1.dot(v2) + v2.squaredNorm());
}

EndForces cable_end_forces(const CableMaterial& m, double L, double gravity, const Chord& c,
                           const EndAccelerations& q) {
  const Vector3 f = cable_force(m, L, c);
  const Vector3 half_weight(0, 0, -0.5 * m.mass_per_length * L * gravity);
  const EndForces inertia = cable_inertia(m, L, q.at1, q.at2);
  return {inertia.on1 - f - half_weight, inertia.on2 + f - half_weight};
}

}   // namespace cablenet::elements
