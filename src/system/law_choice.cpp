#include "law_choice.hpp"

#include <algorithm>

namespace cablenet::system {
namespace {

using elements::AveragedLaw, elements::EnergyMomentumLaw, elements::StageLaw;
using scene::Scheme;

template <bool general>
LawChoice law_of_step(const ForceRule& rule, const Stage& stage, const StepBefore& before) {
  switch (rule.scheme) {
    case Scheme::energy_momentum:
      return EnergyMomentumLaw<general>{
          rule.tangent, stage.alpha_f, stage.dt, rule.axial_dissipation, step_pace(stage.dt, before.dt), before.pace};
    case Scheme::generalized_alpha:
      return AveragedLaw<general>{{rule.tangent}, stage.alpha_f};
    case Scheme::plain:
      break;
  }
  return StageLaw<general>{rule.tangent};
}

}   // namespace

bool ForceRule::is_two_ended() const { return scheme == Scheme::energy_momentum; }

bool ForceRule::has_mean_acceleration() const { return scheme == Scheme::energy_momentum; }

/// PETSc's options may shift the stage, and the formula is that of the mid-point.  In water bodies gain nothing by it.
bool ForceRule::conserves(const Stage& stage, bool in_water) const {
  return scheme == Scheme::energy_momentum && stage.dt > 0 && stage.alpha_f == 0.5 && !in_water;
}

BarLaw choose_bar_law(const ForceRule& rule, const Situation& situation) {
  switch (situation.internal) {
    case InternalForce::of_step:
      if (rule.scheme == Scheme::energy_momentum) return BarLaw::conserving;
      return rule.scheme == Scheme::generalized_alpha ? BarLaw::averaged : BarLaw::of_instant;
    case InternalForce::of_instant:
      return BarLaw::of_instant;
    case InternalForce::of_statics:
      return BarLaw::of_statics;
    case InternalForce::none:
      break;
  }
  return BarLaw::none;
}

LawChoice choose_law(const ForceRule& rule, const Situation& situation, bool is_general, const StepBefore& before) {
  switch (situation.internal) {
    case InternalForce::of_step:
      return is_general ? law_of_step<true>(rule, situation.stage, before)
                        : law_of_step<false>(rule, situation.stage, before);
    case InternalForce::of_instant:
      return elements::StageLaw<true>{rule.tangent};
    case InternalForce::of_statics:
      return elements::StaticLaw{situation.rule, rule.tangent};
    case InternalForce::none:
      break;
  }
  return elements::NoLaw{};
}

}   // namespace cablenet::system
