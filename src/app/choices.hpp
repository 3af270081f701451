#pragma once
#include <string>

#include "cablenet/scene/time.hpp"
#include "cablenet/system/force_rule.hpp"

/// What the scene and the command line together ask for.
namespace cablenet::app {

/// The scene's, with what the command line overrides.  A spectral radius asks for the scheme that has one.
/// @throws InputError
scene::Time chosen_time(scene::Time time);
/// @throws InputError
system::ForceRule force_rule(const scene::Time& time);
/// "generalized_alpha, spectral radius 0.8".
std::string scheme_name(const scene::Time& time, const system::ForceRule& rule);

}   // namespace cablenet::app
