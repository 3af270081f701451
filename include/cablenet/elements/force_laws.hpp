#pragma once
#include "cablenet/elements/turning.hpp"

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
  Turning turning;
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
      keep_direction(e.turning, s);
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
