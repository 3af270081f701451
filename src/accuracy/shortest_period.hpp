#pragma once
#include "cablenet/scene/scene.hpp"

namespace cablenet::accuracy {

/// The shortest period of waves and of moved points, 2 pi over the ratio of acceleration to velocity in root mean
/// squares.  Infinity where nothing swings.  [s]
double shortest_period(const scene::Scene& scene);

}   // namespace cablenet::accuracy
