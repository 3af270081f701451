#pragma once
#include <algorithm>
#include <cmath>

#include "force_laws.hpp"

namespace cablenet::system {

/// Statics' ways to the internal force.
struct StaticLaw {
  static constexpr bool general = true;
  using Start = elements::Stretch;   ///< at the last iterate
  StaticRule rule;

  static Start start(const elements::CableMaterial&, double, const Vector3& d, const Vector3&) {
    return elements::stretch(d);
  }
  template <bool with_tangent>
  bool evaluate(const Start& last, const ElementStage& e, Vector3& f, Matrix3& K) const {
    const elements::Stretch s = elements::stretch(e.d);
    if (rule.kind == StaticRule::Kind::strings) {
      const double density = rule.tension / e.L * std::pow(s.l / e.L, rule.exponent - 1);
      f = density * s.d;
      if constexpr (with_tangent) {
        const Vector3 direction = 1 / s.l * s.d;
        K = elements::axial_and_turning(rule.exponent * density, density, direction, direction);
      }
      return s.l > 0;
    }
    const double EA = std::min(e.material.axial_stiffness, rule.stiffness), strain = (s.l - e.L) / e.L;
    f = EA * strain / s.l * s.d;
    if constexpr (with_tangent) {
      const Vector3 direction = 1 / s.l * s.d;
      // The tension that this correction was expected to bring about, without what turning has stretched.
      const double expected = EA * (last.d.dot(s.d) / last.l - e.L) / e.L, least = rule.tension;
      K = elements::axial_and_turning(EA / e.L, std::max(expected, least) / s.l, direction, direction);
    }
    return s.l > 0;
  }
};

}   // namespace cablenet::system
