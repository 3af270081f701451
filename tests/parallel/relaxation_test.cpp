#include "cablenet/solve/relaxation.hpp"

#include <gtest/gtest.h>

#include "../support/networks.hpp"

using namespace cablenet;
using namespace cablenet::test;

namespace {

network::Network network_from(const std::string& text) {
  return network::build_network(scene::read_scene(text, "test.yaml"));
}

/// Where the network settles from its drawn shape, in a frame that moves at `velocity`.
Field relaxed(const network::Network& network, const Vector3& velocity, double duration) {
  System system(network, {}, PETSC_COMM_WORLD);
  const system::Vector x = system.vector(network.position);
  solve::StaticProgress progress(PETSC_COMM_WORLD);
  EXPECT_TRUE(solve::relax(system.assembler, 0, velocity, duration, progress, x));
  return system.field(x);
}

/// A line drawn straight down below a tow point.
network::Network towed(const std::string& tow, const std::string& current) {
  return network_from(R"(
environment: {fluid: {density: 1025)" +
                      current + R"(}}
cable_types: {line: {mass_per_length: 0.9, axial_stiffness: 1.0e4, diameter: 0.03, normal_drag: 1.2, tangential_drag: 0.02}}
points:
  tow: {position: [0, 0, 0], )" +
                      tow + R"(}
  tail: {position: [0, 0, -10], mass: 1}
cables: {line: {type: line, from: tow, to: tail, elements: 5}}
)");
}

}   // namespace

/// In a ship's frame the water comes from ahead, and a current besides.
TEST(Relaxation, ATowIsACurrentPastAPointThatStays) {
  const Vector3 ship(2, 0.5, 0);
  const std::string drift = ", current: {velocity: [0.25, 0.125, 0]}";
  const network::Network moving = towed("motion: {velocity: [2, 0.5, 0]}", "");
  const network::Network drifting = towed("motion: {velocity: [2, 0.5, 0]}", drift);
  const Field with_ship = relaxed(moving, ship, 60), with_drift = relaxed(drifting, ship, 60);
  const Field past = relaxed(towed("motion: fixed", ", current: {velocity: [-2, -0.5, 0]}"), Vector3::Zero(), 60);
  const Field slower =
      relaxed(towed("motion: fixed", ", current: {velocity: [-1.75, -0.375, 0]}"), Vector3::Zero(), 60);
  EXPECT_LE(size(difference(with_ship, past)), 1e-9);
  EXPECT_LE(size(difference(with_drift, slower)), 1e-9);
  const Vector3 tail = with_ship[SceneNode(1)];
  EXPECT_LT(tail.x(), -5) << "the tail is behind";
  EXPECT_NEAR(tail.y() / tail.x(), 0.25, 1e-6) << "in the ship's wake";
}

/// Two bars that stand as a gable, and would go on standing.
TEST(Relaxation, NothingStandsByCompression) {
  const network::Network gable = network_from(R"(
environment: {gravity: 10}
cable_types: {bar: {mass_per_length: 0.1, axial_stiffness: 1.0e5}}
points:
  left: {position: [-1, 0, 0], motion: fixed}
  right: {position: [1, 0, 0], motion: fixed}
  ridge: {position: [0, 0, 0.5], mass: 2}
cables: {one: {type: bar, from: left, to: ridge, elements: 1}, other: {type: bar, from: ridge, to: right, elements: 1}}
)");
  EXPECT_NEAR(relaxed(gable, Vector3::Zero(), 10)[SceneNode(2)].z(), -0.5, 0.02) << "it hangs";
}

/// The first of its steps takes a ten thousandth of the duration.
TEST(Relaxation, EndsAfterAStepWhereTheTimeIsOver) {
  const Option none("-cable_statics_time_limit", "0");
  const network::Network hanging = towed("motion: fixed", ", current: {velocity: [-2, 0, 0]}");
  EXPECT_NEAR(relaxed(hanging, Vector3::Zero(), 60)[SceneNode(1)].x(), 0, 1e-3) << "the tail has hardly moved";
}
