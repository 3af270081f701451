#pragma once
#include <algorithm>
#include <cmath>

#include "cablenet/elements/force_laws.hpp"
#include "cablenet/elements/static_rule.hpp"

namespace cablenet::elements {

/// Statics' ways to the internal force.
struct StaticLaw {
  static constexpr bool general = true;
  using Start = Stretch;   ///< at the last iterate
  StaticRule rule;

  void begin(const ElementStart& e, Start& start) const { start = stretch(e.d); }
  template <bool with_tangent>
  bool evaluate(const Start& last, const ElementStage& e, Vector3& f, Matrix3& K) const {
    const Stretch s = stretch(e.d);
    const Vector3 direction = 1 / s.l * s.d;
    const double string = rule.string_tension * std::pow(s.l / e.L, rule.exponent);
    if (rule.kind == StaticRule::Kind::strings) {
      f = string * direction;
      if constexpr (with_tangent)
        K = axial_and_turning(rule.exponent * string / s.l, string / s.l, direction, direction);
      return s.l > 0;
    }
    const double EA = e.material.axial_stiffness, strain = (s.l - e.L) / e.L;
    const bool slack = e.material.tension_only && strain <= 0;
    f = slack ? Vector3(0, 0, 0) : Vector3(EA * strain * direction);
    if constexpr (with_tangent) {
      // Without what turning has stretched.
      const double corrected = slack ? 0 : EA * (last.d.dot(s.d) / last.l - e.L) / e.L;
      const double expected = rule.string_tension > 0 ? string : corrected;
      K = axial_and_turning((slack ? rule.least_tension : EA) / e.L, std::max(expected, rule.least_tension) / s.l,
                            direction, direction);
    }
    return s.l > 0;
  }
};

}   // namespace cablenet::elements
