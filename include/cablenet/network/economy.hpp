#pragma once
#include <string>
#include <vector>

#include "cablenet/network/network.hpp"
#include "cablenet/scene/scene.hpp"

/// What a scene has and does not need, as far as it can be told before a run.
/// Tests: tests/cases/economy.py
namespace cablenet::network {

/// Waves that together add less than this part of the water's motion are not needed.
constexpr double faint = 1e-3;

/// "a, b, c and 4 more".
std::string first_of(const std::vector<std::string>& names);

/// "3 of 20 waves add less than 0.1 % of the water's motion ...", or nothing.  @param z the highest place that counts
/// [m]   @param where  says what is there
std::string faint_waves(const scene::Scene& scene, double z, const std::string& where);

/// Sentences on faint waves, on cables that are straight whatever happens, and on bodies that nothing turns.
std::vector<std::string> drawn_economy(const scene::Scene& scene, const Network& network);

}   // namespace cablenet::network
