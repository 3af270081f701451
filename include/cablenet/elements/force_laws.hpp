#pragma once
#include "cablenet/elements/cable_step.hpp"

/// How an element's internal force is taken over a step, with its tangent by the stage's chord.  `general` as in
/// cable_step.hpp; w, the velocity of node 2 relative to node 1, is zero and not looked at where it is false.
namespace cablenet::elements {

/// What a law is told about an element at the stage.
struct ElementStage {
  const CableMaterial& material;
  double L;
  Vector3 d;        ///< x2 - x1 [m]
  Vector3 w;        ///< v2 - v1 [m/s]
  double shift_v;   ///< d w / d d [1/s]
};

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

/// PETSc's own form: the force at the interpolated stage.
template <bool is_general>
struct StageLaw {
  static constexpr bool general = is_general;
  using Start = NoStart;
  Tangent kind;

  static Start start(const CableMaterial&, double, const Vector3&, const Vector3&) { return {}; }
  template <bool with_tangent>
  bool evaluate(const Start&, const ElementStage& e, Vector3& f, Matrix3& K) const {
    const Stretch s = stretch(e.d);
    const double T = instant_tension<general>(e.material, e.L, s, e.w);
    f = T / s.l * s.d;
    if constexpr (with_tangent) {
      const ForceTangent tangent = instant_tangent<general>(e.material, e.L, s, e.w, T, kind);
      K = tangent.d;
      if constexpr (general) K += e.shift_v * tangent.w;
    }
    return s.l > 0;
  }
};

/// The papers' generalised alpha: (1 - alpha_f) f(start) + alpha_f f(end).
template <bool is_general>
struct AveragedLaw {
  static constexpr bool general = is_general;
  using Start = AveragedStart<general>;
  StageLaw<general> end;
  double alpha_f;

  static Start start(const CableMaterial& m, double L, const Vector3& d, const Vector3& w) {
    const Stretch s = stretch(d);
    const Vector3 f = instant_tension<general>(m, L, s, w) / s.l * d;
    if constexpr (general)
      return {d, f, w};
    else
      return {d, f};
  }
  template <bool with_tangent>
  bool evaluate(const Start& start, const ElementStage& e, Vector3& f, Matrix3& K) const {
    ElementStage at_end{e.material, e.L, start.d + (e.d - start.d) / alpha_f, e.w, e.shift_v};
    if constexpr (general) at_end.w = start.w + (e.w - start.w) / alpha_f;
    const bool in_domain = end.template evaluate<with_tangent>({}, at_end, f, K);
    f = (1 - alpha_f) * start.f + alpha_f * f;
    return in_domain;
  }
};

/// Energy-momentum; alpha_f = 1/2 as TSALPHA2 has at radius 1.
template <bool is_general>
struct EnergyMomentumLaw {
  static constexpr bool general = is_general;
  using Start = Stretch;
  Tangent kind;
  double alpha_f;
  double dt;
  double xi;

  static Start start(const CableMaterial&, double, const Vector3& d, const Vector3&) { return stretch(d); }
  template <bool with_tangent>
  bool evaluate(const Start& s0, const ElementStage& e, Vector3& f, Matrix3& K) const {
    const Stretch s1 = stretch(s0.d + (e.d - s0.d) / alpha_f);
    const TensionSlope tension = step_tension<general>(e.material, e.L, s0.l, s1.l, dt, xi);
    f = energy_momentum_force(tension, s0, s1);
    if constexpr (with_tangent) K = 1 / alpha_f * energy_momentum_tangent(tension, s0, s1, kind);
    return s1.l > 0;
  }
};

/// No internal force: leaves the mass matrix.
struct NoLaw {
  static constexpr bool general = false;
  using Start = NoStart;

  template <bool with_tangent>
  bool evaluate(const Start&, const ElementStage&, Vector3& f, Matrix3& K) const {
    f.setZero();
    K.setZero();
    return true;
  }
};

}   // namespace cablenet::elements
