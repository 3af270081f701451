#pragma once
#include <algorithm>
#include <variant>

#include "cablenet/elements/energy_momentum_law.hpp"
#include "cablenet/elements/static_law.hpp"
#include "cablenet/system/force_rule.hpp"
#include "cablenet/system/situation.hpp"

namespace cablenet::system {

/// What the cables' internal force can be in an evaluation.
using LawChoice = std::variant<elements::EnergyMomentumLaw<false>, elements::EnergyMomentumLaw<true>,
                               elements::AveragedLaw<false>, elements::AveragedLaw<true>, elements::StageLaw<false>,
                               elements::StageLaw<true>, elements::StaticLaw, elements::NoLaw>;

/// How a bar's force is taken in an evaluation.
enum class BarLaw {
  none,
  of_instant,   ///< at the stage
  averaged,     ///< (1 - alpha_f) f(start) + alpha_f f(end)
  conserving,   ///< elements::bar_step_force()
  of_statics
};
BarLaw choose_bar_law(const ForceRule& rule, const Situation& situation);

/// How much of ReachedStart::due counts in a step of length dt [s].  A longer step is not to expect more, nor the first
/// one anything: the scheme's proof needs that.
/// @param last_dt  of the step before [s]; 0: there was none
inline double step_pace(double dt, double last_dt) { return last_dt > 0 ? std::min(1.0, dt / last_dt) : 0; }

/// The step before the running one.
struct StepBefore {
  double dt = 0;     ///< [s]; 0: there was none
  double pace = 0;   ///< step_pace() in it
};

/// @param is_general  some material is damped, or goes slack
LawChoice choose_law(const ForceRule& rule, const Situation& situation, bool is_general, const StepBefore& before);

}   // namespace cablenet::system
