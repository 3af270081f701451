#pragma once
#include <string>

#include "cablenet/scene/time.hpp"
#include "cablenet/system/force_rule.hpp"

/// What the scene and the command line together ask for.
namespace cablenet::app {

/// The scene's, with what the command line overrides.  A spectral radius asks for the scheme that has one.
/// @throws InputError
scene::Time chosen_time(scene::Time time);
/// The scheme's, with what -cable_tangent and -cable_axial_dissipation override.  Collective.
/// @throws InputError
system::ForceRule chosen_force_rule(const scene::Time& time);

}   // namespace cablenet::app
