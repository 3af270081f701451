#pragma once
#include <limits>

#include "cablenet/elements/cable_step.hpp"

/// How an element's internal force is taken over a step, with its tangent by the stage's chord.  `general` as in
/// cable_step.hpp; w, the velocity of node 2 relative to node 1, is zero and not looked at where it is false.
namespace cablenet::elements {

/// Which tension turns the chord in a tangent.  Newton's method needs fewer corrections with the tension that the last
/// tangent of the solve lets expect at the present chord than with the force's own, which turning has falsified.  The
/// solution is the same.
/// Source: Magisano, Leonetti & Garcea, Comput. Methods Appl. Mech. Engng 313 (2017) 319.
struct Turning {
  bool is_predicted = false;
  const Vector3* last = nullptr;   ///< the chord's direction at the last tangent; null at a solve's first one
  Vector3* now = nullptr;          ///< where the present direction is kept
  double least = -std::numeric_limits<double>::infinity();   ///< that the predicted tension is taken for [N]
};

/// What a law is told about an element at the stage.
struct ElementStage {
  const CableMaterial& material;
  double L;
  Vector3 d;        ///< x2 - x1 [m]
  Vector3 w;        ///< v2 - v1 [m/s]
  double shift_v;   ///< d w / d d [1/s]
  Turning turning;
};

/// The length that a chord is expected to have, with its direction kept for the next time.
/// @param at_first  that of a solve's first tangent [m]
inline double expected_length(const Turning& turning, const Stretch& s, double at_first) {
  const double length = turning.last == nullptr ? at_first : turning.last->dot(s.d);
  *turning.now = 1 / s.l * s.d;
  return length;
}

/// What a law keeps of an element at the step's start.
struct NoStart {};
template <bool general>
struct AveragedStart {
  Vector3 d, f;
};
template <>
struct AveragedStart<true> {
  Vector3 d, f, w;
};
struct ReachedStart {
  Stretch s;
  double grown;   ///< the change of the elongation that carries tension, in the step before [m]; see EnergyMomentumLaw
};

/// What is told at a step's start.
struct ElementStart {
  const CableMaterial& material;
  double L;
  Vector3 d;   ///< x2 - x1 [m]
  Vector3 w;   ///< v2 - v1 [m/s]
};

/// PETSc's own form: the force at the interpolated stage.
template <bool is_general>
struct StageLaw {
  static constexpr bool general = is_general;
  using Start = NoStart;
  Tangent kind;

  void begin(const ElementStart&, Start&) const {}
  template <bool with_tangent>
  bool evaluate(const Start&, const ElementStage& e, Vector3& f, Matrix3& K) const {
    const Stretch s = stretch(e.d);
    const double T = instant_tension<general>(e.material, e.L, s, e.w);
    f = T / s.l * s.d;
    if constexpr (with_tangent) {
      const double turning = e.turning.is_predicted ? expected_tension(e, s) : T;
      const ForceTangent tangent = instant_tangent<general>(e.material, e.L, s, e.w, T, turning, kind);
      K = tangent.d;
      if constexpr (general) K += e.shift_v * tangent.w;
    }
    return s.l > 0;
  }
  static double expected_tension(const ElementStage& e, const Stretch& s) {
    const double length = expected_length(e.turning, s, s.l);
    return std::max(instant_tension<general>(e.material, e.L, {length / s.l * s.d, length}, e.w), e.turning.least);
  }
};

/// The papers' generalised alpha: (1 - alpha_f) f(start) + alpha_f f(end).
template <bool is_general>
struct AveragedLaw {
  static constexpr bool general = is_general;
  using Start = AveragedStart<general>;
  StageLaw<general> end;
  double alpha_f;

  void begin(const ElementStart& e, Start& start) const {
    const Stretch s = stretch(e.d);
    start.d = e.d;
    start.f = instant_tension<general>(e.material, e.L, s, e.w) / s.l * e.d;
    if constexpr (general) start.w = e.w;
  }
  template <bool with_tangent>
  bool evaluate(const Start& start, const ElementStage& e, Vector3& f, Matrix3& K) const {
    ElementStage at_end{e.material, e.L, start.d + (e.d - start.d) / alpha_f, e.w, e.shift_v, e.turning};
    if constexpr (general) at_end.w = start.w + (e.w - start.w) / alpha_f;
    const bool in_domain = end.template evaluate<with_tangent>({}, at_end, f, K);
    f = (1 - alpha_f) * start.f + alpha_f * f;
    return in_domain;
  }
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
  double pace;     ///< over ReachedStart::grown: what is expected to be carried in this step
  bool is_first;   ///< No step came before.  The rate of the elongation [m/s] stands in for what has grown in one.

  void begin(const ElementStart& e, Start& start) const {
    const Stretch s = stretch(e.d);
    const double carried = carried_elongation<general>(e.material, s.l - e.L);
    start.grown = carried - carried_elongation<general>(e.material, start.s.l - e.L);
    if (is_first) start.grown = carries<general>(e.material, s.l - e.L) ? s.d.dot(e.w) / s.l : 0.0;
    start.s = s;
  }
  template <bool with_tangent>
  bool evaluate(const Start& start, const ElementStage& e, Vector3& f, Matrix3& K) const {
    const Stretch& s0 = start.s;
    const Stretch s1 = stretch(s0.d + (e.d - s0.d) / alpha_f);
    LengthStep step{s0.l, s1.l, dt, xi, pace * start.grown};
    const TensionSlope tension = step_tension<general>(e.material, e.L, step);
    f = energy_momentum_force(tension, s0, s1);
    if constexpr (with_tangent) {
      double turning = tension.T;
      if (e.turning.is_predicted) {
        step.l1 = expected_length(e.turning, s1, s0.l);
        turning = std::max(step_tension<general>(e.material, e.L, step).T, e.turning.least);
      }
      K = 1 / alpha_f * energy_momentum_tangent(tension.slope, turning, s0, s1, kind);
    }
    return s1.l > 0;
  }
};

/// No internal force: leaves the mass matrix.
struct NoLaw {
  static constexpr bool general = false;
  using Start = NoStart;

  void begin(const ElementStart&, Start&) const {}
  template <bool with_tangent>
  bool evaluate(const Start&, const ElementStage&, Vector3& f, Matrix3& K) const {
    f.setZero();
    K.setZero();
    return true;
  }
};

}   // namespace cablenet::elements
