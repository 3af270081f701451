#pragma once
#include <string>
#include <vector>

#include "cablenet/network/network.hpp"
#include "cablenet/scene/scene.hpp"

/// Tests: tests/cases/drawn.py
namespace cablenet::network {

/// What is drawn so that a run from it hardly begins as anybody means: nodes inside the bed, and cables that are drawn
/// much stretched.  An equilibrium forgets what is drawn, so that only a cable between two held ends is looked at
/// there. A note begins as those of the scene do, "file:line: key: ".
std::vector<std::string> drawn_notes(const scene::Scene& scene, const Network& network);

}   // namespace cablenet::network
