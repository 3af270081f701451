#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "cablenet/elements/force_laws.hpp"
#include "cablenet/elements/static_rule.hpp"

namespace cablenet::elements {

/// A tension T, its derivative by the strain and its integral over the strain.  [N]
struct StaticTension {
  double T, stiffness, energy;
};

/// T = EA strain, or 0 where the element is slack, as a rule has it that is not of strings.
/// @param softened  the most that EA is in a descent [N]
inline StaticTension static_tension(const StaticRule& rule, const CableMaterial& material, double strain,
                                    double softened) {
  const double most = rule.kind == StaticRule::Kind::descent ? softened : rule.most_stiffness;
  const double EA = std::min({material.axial_stiffness, rule.most_stiffness, most});
  if ((material.tension_only || rule.never_pushes) && strain <= 0) return {0, 0, 0};
  return {EA * strain, EA, 0.5 * EA * strain * strain};
}

/// What statics keeps of an element.
struct StaticStart {
  Stretch s;   ///< at the last iterate
  /// To which it was softened (StaticRule::Softening).  [N]
  double softened = std::numeric_limits<double>::infinity();
};

/// Statics' ways to the internal force.  Nothing is damped.
struct StaticLaw {
  static constexpr bool general = false;
  using Start = StaticStart;
  StaticRule rule;
  Tangent kind = Tangent::exact;

  void begin(const ElementStart& e, Start& start) const {
    start.s = stretch(e.d);
    if (rule.softening.ratio == 0) return;
    const double T = static_tension(rule, e.material, (start.s.l - e.L) / e.L, start.softened).T;
    start.softened = rule.softening.ratio * (rule.softening.over_tension * std::abs(T) + rule.softening.least);
  }
  template <bool with_tangent>
  bool evaluate(const Start& last, const ElementStage& e, Vector3& f, Matrix3& K) const {
    const Stretch s = stretch(e.d);
    const Vector3 direction = 1 / s.l * s.d;
    if (rule.kind == StaticRule::Kind::strings) {
      const double string = string_tension(s.l, e.L);
      f = string * direction;
      if constexpr (with_tangent)
        K = axial_and_turning(rule.exponent * string / s.l, string / s.l, direction, direction);
      return s.l > 0;
    }
    const StaticTension now = static_tension(rule, e.material, (s.l - e.L) / e.L, last.softened);
    f = now.T * direction;
    if constexpr (with_tangent) {
      const double axial = std::max(now.stiffness, rule.least_tension);
      K = axial_and_turning(axial / e.L, turning(last, e, s, now) / s.l, direction, direction);
      K.diagonal().array() += rule.holding / e.L;
    }
    return s.l > 0;
  }

private:
  double string_tension(double l, double L) const { return rule.string_tension * std::pow(l / L, rule.exponent); }

  /// The tension that turns the chord.  What turning has stretched is left out on the way.
  double turning(const Start& last, const ElementStage& e, const Stretch& s, const StaticTension& now) const {
    if (rule.kind == StaticRule::Kind::exact) return kind == Tangent::secant ? 0 : now.T;
    if (rule.kind == StaticRule::Kind::ropes && rule.string_tension > 0)
      return std::max(string_tension(s.l, e.L), rule.least_tension);
    if (now.stiffness == 0) return rule.least_tension;
    const double strain = (last.s.d.dot(s.d) / last.s.l - e.L) / e.L;
    return std::max(static_tension(rule, e.material, strain, last.softened).T, rule.least_tension);
  }
};

}   // namespace cablenet::elements
