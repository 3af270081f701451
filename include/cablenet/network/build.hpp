#pragma once
#include "cablenet/network/network.hpp"
#include "cablenet/scene/scene.hpp"

/// Tests: tests/parallel/build_test.cpp
namespace cablenet::network {

/// Discretises the scene.  A cable's nodes lie along its drawn shape, and a net's nodes form a grid.  A tap, at which
/// one cable branches from another, is a node of the tapped cable.  That cable's elements are distributed between its
/// taps: there are as many as the scene says, and those between two taps are equally long.
/// @throws InputError where drawn shapes and lengths do not fit together.
Network build_network(const scene::Scene& scene);

}   // namespace cablenet::network
