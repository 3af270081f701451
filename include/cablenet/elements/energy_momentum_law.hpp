#pragma once
#include <algorithm>

#include "cablenet/elements/energy_momentum_step.hpp"
#include "cablenet/elements/force_laws.hpp"

namespace cablenet::elements {

/// What the law keeps of an element at a step's start.
struct ReachedStart {
  Stretch s;
  double due;   ///< next_due() of the step before [m]
};

/// Energy-momentum, at alpha_f = 1/2.
template <bool is_general>
struct EnergyMomentumLaw {
  static constexpr bool general = is_general;
  using Start = ReachedStart;
  Tangent kind;
  double alpha_f;
  double dt;
  double xi;
  double pace;         ///< factor of ReachedStart::due in this step; 0 in a run's first step
  double taken_pace;   ///< the same factor in the step before

  void begin(const ElementStart& e, Start& start) const {
    const Stretch s = stretch(e.d);
    const double carried = carried_elongation<general>(e.material, s.l - e.L);
    const double grown = carried - carried_elongation<general>(e.material, start.s.l - e.L);
    start.due = next_due(grown, taken_pace * start.due);
    start.s = s;
  }
  template <bool with_tangent>
  bool evaluate(const Start& start, const ElementStage& e, Vector3& f, Matrix3& K) const {
    const Stretch& s0 = start.s;
    const Stretch s1 = stretch(s0.d + (e.d - s0.d) / alpha_f);
    LengthStep step{s0.l, s1.l, dt, xi, pace * start.due};
    const TensionSlope tension = step_tension<general>(e.material, e.L, step);
    f = tension.T * mean_direction(s0, s1);
    if constexpr (with_tangent) {
      double turning = tension.T;
      if (e.turning.is_predicted) {
        step.l1 = expected_length(e.turning, s1, s0.l);
        turning = std::max(step_tension<general>(e.material, e.L, step).T, e.turning.least);
      }
      K = energy_momentum_tangent(1 / alpha_f * tension.slope, 1 / alpha_f * turning, s0, s1, kind);
      keep_direction(e.turning, s1);
    }
    return s1.l > 0;
  }
};

}   // namespace cablenet::elements
