#pragma once
#include <algorithm>

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
inline Vector3 direction(const Stretch& s) { return 1 / s.l * s.d; }

inline bool is_elastic(const CableMaterial& m) {
  return m.axial_damping == 0 && m.mass_damping == 0 && !m.tension_only;
}

template <bool general>
bool carries(const CableMaterial& m, double elongation) {
  if constexpr (general) return !m.tension_only || elongation > 0;
  return true;
}

/// The tension at an instant, with w = v2 - v1.
template <bool general>
double instant_tension(const CableMaterial& m, double L, const Stretch& s, const Vector3& w) {
  const double elastic = m.axial_stiffness * ((s.l - L) / L);
  if constexpr (!general) return elastic;
  if (!carries<general>(m, s.l - L)) return 0;
  const double tension = elastic + m.axial_damping * s.d.dot(w) / (s.l * L);
  return m.tension_only ? std::max(tension, 0.0) : tension;
}

/// a mean e^T + b (I - mean e^T).
inline Matrix3 axial_and_turning(double a, double b, const Vector3& mean, const Vector3& e) {
  Matrix3 K = (a - b) * mean * e.transpose();
  K.diagonal().array() += b;
  return K;
}

/// @param T        at the instant [N]
/// @param turning  the tension that turns the chord: T, or one that was predicted [N]
template <bool general>
ForceTangent instant_tangent(const CableMaterial& m, double L, const Stretch& s, const Vector3& w, double T,
                             double turning, Tangent kind) {
  const bool is_silent = general && m.tension_only && T <= 0;
  const Vector3 e = 1 / s.l * s.d;
  const double k = is_silent ? 0 : m.axial_stiffness / L;
  ForceTangent K{axial_and_turning(k, kind == Tangent::secant ? 0 : turning / s.l, e, e), Matrix3::Zero()};
  if (is_silent) return K;
  if constexpr (general) {
    K.w = m.axial_damping / L * e * e.transpose();
    if (kind == Tangent::exact) K.d += m.axial_damping / (s.l * L) * e * (w - e * e.dot(w)).transpose();
  }
  return K;
}

}   // namespace cablenet::elements
