#include "cablenet/elements/cable.hpp"

namespace cablenet::elements {
namespace {

bool carries(const CableMaterial& m, double strain) { return !m.tension_only || strain > 0; }

/// Tension over a step and its derivative by the end's strain.
struct StepTension {
  double value;
  double slope;
};

/// Strain beyond which a tension_only element carries, at both ends of the step, and the taut fraction of the step
/// with its derivative by the end's strain: the discrete gradient of the ramp's energy.
struct Ramp {
  double p0, p1, dp1, taut, dtaut;
};

Ramp ramp(const CableMaterial& m, double strain0, double strain1) {
  const bool taut0 = carries(m, strain0);
  const bool taut1 = carries(m, strain1);
  const double rise = strain1 - strain0;
  if (taut0 && taut1) return {strain0, strain1, 1, 1, 0};
  if (taut1) return {0, strain1, 1, strain1 / rise, -strain0 / (rise * rise)};
  if (taut0) return {strain0, 0, 0, -strain0 / rise, strain0 / (rise * rise)};
  return {0, 0, 0, 0, 0};
}

StepTension step_tension(const CableMaterial& m, double strain0, double strain1, const ChordStep& s) {
  const Ramp r = ramp(m, strain0, strain1);
  const double rise = strain1 - strain0;
  const double mean = 0.5 * (r.p0 + r.p1);
  const double rate = m.axial_damping / s.dt;
  return {m.axial_stiffness * (r.taut * mean + s.xi * (r.p1 - r.p0)) + rate * r.taut * rise,
          m.axial_stiffness * (r.dtaut * mean + (0.5 * r.taut + s.xi) * r.dp1) + rate * (r.dtaut * rise + r.taut)};
}

}   // namespace

double cable_tension(const CableMaterial& m, double L, const Chord& c) {
  const double l = c.d.norm();
  const double strain = (l - L) / L;
  if (!carries(m, strain)) return 0;
  return m.axial_stiffness * strain + m.axial_damping * c.d.dot(c.w) / (l * L);
}

Vector3 cable_force(const CableMaterial& m, double L, const Chord& c) {
  return cable_tension(m, L, c) / c.d.norm() * c.d;
}

ForceTangent cable_force_tangent(const CableMaterial& m, double L, const Chord& c, Tangent kind) {
  const double l = c.d.norm();
  const Vector3 e = c.d / l;
  if (!carries(m, (l - L) / L)) return {Matrix3::Zero(), Matrix3::Zero()};
  const Matrix3 axial = e * e.transpose();
  const Matrix3 damping = m.axial_damping / L * axial;
  if (kind == Tangent::secant) return {m.axial_stiffness / L * axial, damping};
  const double T = cable_tension(m, L, c);
  const Vector3 slope = (m.axial_stiffness * e + m.axial_damping / l * (c.w - e * e.dot(c.w))) / L;
  return {e * slope.transpose() + T / l * (Matrix3::Identity() - axial), damping};
}

Vector3 energy_momentum_force(const CableMaterial& m, double L, const ChordStep& s) {
  const double l0 = s.d0.norm();
  const double l1 = s.d1.norm();
  return step_tension(m, (l0 - L) / L, (l1 - L) / L, s).value / (l0 + l1) * (s.d0 + s.d1);
}

Matrix3 energy_momentum_tangent(const CableMaterial& m, double L, const ChordStep& s, Tangent kind) {
  const double l0 = s.d0.norm();
  const double l1 = s.d1.norm();
  const Vector3 e1 = s.d1 / l1;
  const Vector3 mean = (s.d0 + s.d1) / (l0 + l1);
  const StepTension T = step_tension(m, (l0 - L) / L, (l1 - L) / L, s);
  if (kind == Tangent::secant) return T.slope / L * mean * mean.transpose();
  return T.slope / L * mean * e1.transpose() + T.value / (l0 + l1) * (Matrix3::Identity() - mean * e1.transpose());
}

double cable_strain_energy(const CableMaterial& m, double L, const Vector3& d) {
  const double strain = (d.norm() - L) / L;
  return carries(m, strain) ? 0.5 * m.axial_stiffness * L * strain * strain : 0.0;
}

double cable_kinetic_energy(const CableMaterial& m, double L, const Vector3& v1, const Vector3& v2) {
  return m.mass_per_length * L / 6 * (v1.squaredNorm() + v1.dot(v2) + v2.squaredNorm());
}

EndForces cable_inertia(const CableMaterial& m, double L, const Vector3& q1, const Vector3& q2) {
  const double sixth = m.mass_per_length * L / 6;
  return {sixth * (2 * q1 + q2), sixth * (q1 + 2 * q2)};
}

EndForces cable_end_forces(const CableMaterial& m, double L, double gravity, const Chord& c, const EndForces& q) {
  const Vector3 f = cable_force(m, L, c);
  const Vector3 half_weight(0, 0, -0.5 * m.mass_per_length * L * gravity);
  const EndForces inertia = cable_inertia(m, L, q.on1, q.on2);
  return {inertia.on1 - f - half_weight, inertia.on2 + f - half_weight};
}

}   // namespace cablenet::elements
