#pragma once
#include <functional>
#include <string>

#include "cablenet/accuracy/ladder.hpp"
#include "cablenet/app/report.hpp"
#include "cablenet/scene/scene.hpp"

namespace cablenet::app {

/// Says how accurate a run is.
struct Judge {
  double interval = 0;                                           ///< of the rows that it sees [s]
  std::function<Report::Accuracy(accuracy::Trial)> judge = {};   ///< collective
};

/// Discretises, solves and writes a scene.  Collective.
/// @param directory for the results
/// @param judge  of the run when it has come to its end; none: nobody asks
/// @returns 0 done, 3 the solver could not go on (said, and the last good state saved)
/// @throws InputError, OutputError on every rank alike; a write that fails on one rank ends all ranks with status 4.
int simulate(const scene::Scene& scene, const std::string& directory, const Judge& judge = {});

}   // namespace cablenet::app
