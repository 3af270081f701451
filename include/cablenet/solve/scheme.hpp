#pragma once
#include <string>

#include "cablenet/scene/time.hpp"
#include "cablenet/solve/alpha_step.hpp"
#include "cablenet/system/force_rule.hpp"

/// What the solvers and the program have to know of a scheme: one row per scheme, in scheme.cpp.  All schemes step with
/// the generalised-alpha method; they differ in how the cables' forces are taken over a step
/// (src/system/law_choice.cpp).
namespace cablenet::solve {

struct SchemeRow {
  scene::Scheme scheme;
  bool has_axial_dissipation;
  AlphaWeights (*weights)(
      double spectral_radius);   ///< The radius says how much of what the step does not resolve stays.
  const char* advice;            ///< what may help where Newton's method fails: "Try a smaller time.step or ..."
};

const SchemeRow& row_of(scene::Scheme scheme);

/// The method's weights for the scheme and its spectral radius.
AlphaWeights weights_of(const scene::Time& time);

/// How the internal force is taken, with the scene's axial dissipation and the exact tangent.
system::ForceRule force_rule_of(const scene::Time& time);

/// "generalized_alpha, spectral radius 0.8".
std::string describe(const scene::Time& time, const system::ForceRule& rule);

}   // namespace cablenet::solve
