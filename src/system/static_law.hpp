#pragma once
#include <algorithm>

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
    if (rule.kind == StaticRule::Kind::strings) {
      const double density = rule.tension / e.L;
      f = density * e.d;
      K = density * Matrix3::Identity();
      return true;
    }
    const elements::Stretch s = elements::stretch(e.d);
    const double EA = std::min(e.material.axial_stiffness, rule.stiffness), strain = (s.l - e.L) / e.L;
    f = EA * std::max(strain, 0.0) / s.l * s.d;
    if constexpr (with_tangent) {
      const Vector3 direction = 1 / s.l * s.d;
      // The tension that this correction was expected to bring about, without what turning has stretched.
      const double expected = EA * (last.d.dot(s.d) / last.l - e.L) / e.L, least = rule.tension;
      K = elements::axial_and_turning(strain > 0 ? EA / e.L : least / e.L, std::max(expected, least) / s.l, direction,
                                      direction);
    }
    return s.l > 0;
  }
};

}   // namespace cablenet::system
