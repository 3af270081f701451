#pragma once
#include <vector>

#include "cablenet/network/network.hpp"

/// Cables and nets whose lengths are found with the equilibrium: what is known of them before.
/// Tests: tests/verification/pretension.py
namespace cablenet::network {

std::vector<Pretension> pretensions_of(const scene::Scene& scene);

/// The unstretched length from which the search starts, [m]: that between its drawn ends at the cable's tension T, with
/// the sag of a parabola, d (1 + (w h/T)^2/24)/(1 + T/EA), but no much longer one.  w is the weight per length, h the
/// horizontal distance.
double first_length(const scene::Scene& scene, const scene::Cable& cable, const Vector3& a, const Vector3& b);

/// Of a net, likewise: as it is drawn its twines have the tension.
double first_slack(const scene::Scene& scene, const scene::Net& net);

}   // namespace cablenet::network
