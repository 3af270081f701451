#pragma once
#include "cablenet/elements/cable.hpp"

/// The forces of cable.hpp in the form that the loop over elements inlines.  Where `general` is false the material is
/// purely elastic: it has no damping and carries compression.  The compiler then leaves out the code for both.
/// Source and tests: see cable.hpp.
namespace cablenet::elements {

/// A chord d and its length l [m].
struct Stretch {
  Vector3 d;
  double l;
};

inline Stretch stretch(const Vector3& d) { return {d, d.norm()}; }

/// A tension T [N] and its derivative by the length [N/m].
struct TensionSlope {
  double T;
  double slope;
};

inline bool is_elastic(const CableMaterial& m) {
  return m.axial_damping == 0 && m.mass_damping == 0 && !m.tension_only;
}

template <bool general>
bool carries(const CableMaterial& m, double elongation) {
  if constexpr (general) return !m.tension_only || elongation > 0;
  return true;
}

/// p0 and p1 are the elongations that carry tension at the start and at the end of a step: a slack tension_only element
/// has 0.  `taut` is the fraction of the step in which the element carries.  dp1 and dtaut are derivatives by the
/// elongation at the end.  Together they give the discrete gradient of the strain energy.
struct Ramp {
  double p0, p1, dp1, taut, dtaut;
};

inline Ramp ramp(const CableMaterial& m, double elongation0, double elongation1) {
  const bool taut0 = carries<true>(m, elongation0);
  const bool taut1 = carries<true>(m, elongation1);
  const double rise = elongation1 - elongation0;
  if (taut0 && taut1) return {elongation0, elongation1, 1, 1, 0};
  if (taut1) return {0, elongation1, 1, elongation1 / rise, -elongation0 / (rise * rise)};
  if (taut0) return {elongation0, 0, 0, -elongation0 / rise, elongation0 / (rise * rise)};
  return {0, 0, 0, 0, 0};
}

/// The tension of the energy-momentum scheme in a step of length dt, in which the element's length goes from l0 to l1.
template <bool general>
TensionSlope step_tension(const CableMaterial& m, double L, double l0, double l1, double dt, double xi) {
  const double k = m.axial_stiffness / L;
  const double rise = l1 - l0;
  if constexpr (!general) return {k * (0.5 * ((l0 - L) + (l1 - L)) + xi * rise), k * (0.5 + xi)};
  const Ramp r = ramp(m, l0 - L, l1 - L);
  const double mean = 0.5 * (r.p0 + r.p1);
  const double rate = m.axial_damping / (L * dt);
  return {k * (r.taut * mean + xi * (r.p1 - r.p0)) + rate * r.taut * rise,
          k * (r.dtaut * mean + (0.5 * r.taut + xi) * r.dp1) + rate * (r.dtaut * rise + r.taut)};
}

/// The tension at an instant, with w = v2 - v1.
template <bool general>
double instant_tension(const CableMaterial& m, double L, const Stretch& s, const Vector3& w) {
  if (!carries<general>(m, s.l - L)) return 0;
  const double elastic = m.axial_stiffness * ((s.l - L) / L);
  if constexpr (general) return elastic + m.axial_damping * s.d.dot(w) / (s.l * L);
  return elastic;
}

/// a mean e^T + b (I - mean e^T).
inline Matrix3 axial_and_turning(double a, double b, const Vector3& mean, const Vector3& e) {
  Matrix3 K = (a - b) * mean * e.transpose();
  K.diagonal().array() += b;
  return K;
}

inline Vector3 energy_momentum_force(const TensionSlope& tension, const Stretch& s0, const Stretch& s1) {
  return tension.T / (s0.l + s1.l) * (s0.d + s1.d);
}

inline Matrix3 energy_momentum_tangent(const TensionSlope& tension, const Stretch& s0, const Stretch& s1,
                                       Tangent kind) {
  const double both = 1 / (s0.l + s1.l);
  const Vector3 mean = both * (s0.d + s1.d);
  if (kind == Tangent::secant) return tension.slope * mean * mean.transpose();
  return axial_and_turning(tension.slope, both * tension.T, mean, 1 / s1.l * s1.d);
}

template <bool general>
ForceTangent instant_tangent(const CableMaterial& m, double L, const Stretch& s, const Vector3& w, double T,
                             Tangent kind) {
  if (!carries<general>(m, s.l - L)) return {Matrix3::Zero(), Matrix3::Zero()};
  const Vector3 e = 1 / s.l * s.d;
  const double k = m.axial_stiffness / L;
  ForceTangent K{axial_and_turning(k, kind == Tangent::secant ? 0 : T / s.l, e, e), Matrix3::Zero()};
  if constexpr (general) {
    K.w = m.axial_damping / L * e * e.transpose();
    if (kind == Tangent::exact) K.d += m.axial_damping / (s.l * L) * e * (w - e * e.dot(w)).transpose();
  }
  return K;
}

}   // namespace cablenet::elements
