#pragma once
#include "cablenet/elements/cable_step.hpp"

/// The force of the energy-momentum scheme, in the form that the loop over elements inlines.  `general` as in
/// cable_step.hpp.  Source and tests: see cable.hpp.
namespace cablenet::elements {

/// A tension T [N] and its derivative by the length [N/m].
struct TensionSlope {
  double T;
  double slope;
};

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

/// An element's step from length l0 to l1 in the energy-momentum scheme.
struct LengthStep {
  double l0, l1;   ///< [m]
  double dt;       ///< [s]
  double xi;       ///< axial dissipation
  double due;      ///< the change of p that the step before lets expect [m]
};

/// What the change of p is expected to be in the next step, after one in which it was `grown` instead of `due`:
///   due' = grown + a (grown - due)
/// With a = 0 the term in xi would be a second difference.  For the same effect where p alternates from step to step,
/// this filter takes (1 + a)^2/(1 - a) = 8 times less where p is smooth.  It never adds energy: src/numerics.md.
inline double next_due(double grown, double due) {
  constexpr double a = 0.65;
  return grown + a * (grown - due);
}

/// The elongation that carries tension.  [m]
template <bool general>
double carried_elongation(const CableMaterial& m, double elongation) {
  return carries<general>(m, elongation) ? elongation : 0.0;
}

/// T = theta (EA/L ((p0 + p1)/2 + xi (p1 - p0 - due)) + c/L (l1 - l0)/dt), theta = (p1 - p0)/(l1 - l0).
/// A tension_only element pulls or is silent.
template <bool general>
TensionSlope step_tension(const CableMaterial& m, double L, const LengthStep& s) {
  const double k = m.axial_stiffness / L, rise = s.l1 - s.l0;
  if constexpr (!general) return {k * (0.5 * ((s.l0 - L) + (s.l1 - L)) + s.xi * (rise - s.due)), k * (0.5 + s.xi)};
  const Ramp r = ramp(m, s.l0 - L, s.l1 - L);
  const double rate = m.axial_damping / (L * s.dt);
  const double full = k * (0.5 * (r.p0 + r.p1) + s.xi * (r.p1 - r.p0 - s.due)) + rate * rise;
  if (m.tension_only && r.taut * full <= 0) return {0, 0};
  return {r.taut * full, r.dtaut * full + r.taut * (k * (0.5 + s.xi) * r.dp1 + rate)};
}

/// Along which the tension acts.  It is 1 long where the chord does not turn.
inline Vector3 mean_direction(const Stretch& s0, const Stretch& s1) { return 1 / (s0.l + s1.l) * (s0.d + s1.d); }

/// @param turning  the tension that turns the chord: the step's, or one that was predicted [N]
inline Matrix3 energy_momentum_tangent(double slope, double turning, const Stretch& s0, const Stretch& s1,
                                       Tangent kind) {
  const Vector3 mean = mean_direction(s0, s1), end = direction(s1);
  if (kind == Tangent::secant) return slope * mean * mean.transpose();
  return axial_and_turning(slope, 1 / (s0.l + s1.l) * turning, mean, end);
}

}   // namespace cablenet::elements
