#pragma once
#include <string>

#include "cablenet/app/report.hpp"
#include "cablenet/scene/scene.hpp"

namespace cablenet::app {

/// Discretises, solves and writes a scene.  Collective.
/// @param directory for the results
/// @returns 0 done, 3 the solver could not go on (said, and the last good state saved)
/// @throws InputError, OutputError on every rank alike; a write that fails on one rank ends all ranks with status 4.
int simulate(const scene::Scene& scene, const std::string& directory);

}   // namespace cablenet::app
