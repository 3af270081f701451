#pragma once
#include <vector>

#include "cablenet/accuracy/fineness.hpp"
#include "cablenet/accuracy/ladder.hpp"
#include "cablenet/scene/scene.hpp"

namespace cablenet::app {

struct CoarseRun {
  accuracy::Trial trial;
  std::vector<accuracy::Bending> bends;   ///< as accuracy::Mesh::grade takes them
};

/// Runs a scene, keeps its history, writes nothing and says nothing.  Collective.
/// @throws InputError
CoarseRun run_coarsely(const scene::Scene& scene);

}   // namespace cablenet::app
