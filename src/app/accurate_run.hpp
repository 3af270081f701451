#pragma once
#include <string>

#include "cablenet/scene/scene.hpp"

/// Runs of scenes that ask for an accuracy.  Tests: tests/cases/accuracy.py
namespace cablenet::app {

/// Chooses the elements and steps that a scene leaves open, by coarse runs, and makes the run.  It is made again, with
/// finer ones, where it turns out to err by more than what is asked for.  Collective.
/// @returns as simulate()
/// @throws as simulate()
int simulate_accurately(const scene::Scene& scene, const std::string& directory);

/// The scene of the first coarse run.
scene::Scene first_choice(const scene::Scene& scene);

}   // namespace cablenet::app
