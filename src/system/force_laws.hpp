#pragma once
#include "cablenet/elements/cable.hpp"

/// How an element's internal force is taken over a step, and its tangent by the stage's chord.
/// start: chord and force at the step's start; chord: at the stage; end(): at the step's end, from both.
namespace cablenet::system {

/// What a law is told about an element.
struct ElementStep {
  const elements::CableMaterial& material;
  double L;
  const elements::Chord& stage;
  const elements::Chord& start;
  const Vector3& start_force;
};

inline elements::Chord end_chord(const ElementStep& e, double alpha_f) {
  return {e.start.d + (e.stage.d - e.start.d) / alpha_f, e.start.w + (e.stage.w - e.start.w) / alpha_f};
}

/// PETSc's own form: the force at the interpolated stage.
struct StageLaw {
  elements::Tangent kind;
  bool in_domain(const ElementStep& e) const { return e.stage.d.squaredNorm() > 0; }
  Vector3 force(const ElementStep& e) const { return elements::cable_force(e.material, e.L, e.stage); }
  Matrix3 tangent(const ElementStep& e, double shift_v) const {
    const auto K = elements::cable_force_tangent(e.material, e.L, e.stage, kind);
    return K.d + shift_v * K.w;
  }
};

/// The papers' generalised alpha: (1 - alpha_f) f(start) + alpha_f f(end).
struct AveragedLaw {
  elements::Tangent kind;
  double alpha_f;
  bool in_domain(const ElementStep& e) const { return end_chord(e, alpha_f).d.squaredNorm() > 0; }
  Vector3 force(const ElementStep& e) const {
    return (1 - alpha_f) * e.start_force + alpha_f * elements::cable_force(e.material, e.L, end_chord(e, alpha_f));
  }
  Matrix3 tangent(const ElementStep& e, double shift_v) const {
    const auto K = elements::cable_force_tangent(e.material, e.L, end_chord(e, alpha_f), kind);
    return K.d + shift_v * K.w;
  }
};

/// Energy-momentum; alpha_f = 1/2 as TSALPHA2 has at radius 1.
struct EnergyMomentumLaw {
  elements::Tangent kind;
  double alpha_f;
  double dt;
  double xi;
  bool in_domain(const ElementStep& e) const { return end_chord(e, alpha_f).d.squaredNorm() > 0; }
  Vector3 force(const ElementStep& e) const {
    return elements::energy_momentum_force(e.material, e.L, {e.start.d, end_chord(e, alpha_f).d, dt, xi});
  }
  Matrix3 tangent(const ElementStep& e, double) const {
    return elements::energy_momentum_tangent(e.material, e.L, {e.start.d, end_chord(e, alpha_f).d, dt, xi}, kind) /
           alpha_f;
  }
};

/// No internal force: leaves the mass matrix.
struct NoLaw {
  bool in_domain(const ElementStep&) const { return true; }
  Vector3 force(const ElementStep&) const { return Vector3::Zero(); }
  Matrix3 tangent(const ElementStep&, double) const { return Matrix3::Zero(); }
};

}   // namespace cablenet::system
