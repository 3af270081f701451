#pragma once
#include "cablenet/network/network.hpp"
#include "cablenet/scene/scene.hpp"

/// Tests: tests/parallel/build_test.cpp
namespace cablenet::network {

/// Discretises the scene: nodes along drawn shapes, taps as nodes of their trunk, nets as grids.
/// A tap that falls between a cable's evenly spaced nodes shares the cable's elements out anew, so that their number
/// stays the scene's and they are even between taps.
/// @throws InputError where drawn shapes and lengths do not fit together.
Network build_network(const scene::Scene& scene);

}   // namespace cablenet::network
