#include <gtest/gtest.h>

#include <numbers>

#include "../support/scenes.hpp"
#include "../support/stages.hpp"
#include "cablenet/solve/static_forces.hpp"

/// What touches the bed beside cables, and how the bed bears it.  bed_friction_test.cpp tests the tangent.
namespace cablenet::test {
namespace {

const std::string types = "cable_types: {rope: {mass_per_length: 0.9, axial_stiffness: 2000, diameter: 0.03}}\n";

network::Network network_of(const std::string& seabed, const std::string& text) {
  const std::string environment = "environment: {gravity: 9.81, seabed: {" + seabed + "}}\n";
  return network::build_network(scene::read_scene(environment + types + text + "time: {end: 1, step: 0.1}\n", "bed"));
}

/// Where each spot reaches on the scene's network.
TEST(BedSpots, AreThoseOfFreePointsAndOfBodies) {
  const std::string text = R"(
points:
  held: {position: [0, 0, 0], motion: fixed, mass: 1}
  plain: {position: [1, 0, 0], mass: 1}
  none: {position: [2, 0, 0], mass: 1, volume: 0.1, contact_radius: 0}
  shoe: {position: [3, 0, 0], mass: 1, contact_radius: 0.25}
  buoy: {position: [4, 0, 0], mass: 1, volume: 4.1887902047863905}
bodies:
  box: {mass: 12, inertia: [13, 10, 5], position: [5, 0, 0], attachments: {eye: [0, 0, 0]}}
  bare: {mass: 12, inertia: [13, 10, 5], position: [6, 0, 0], attachments: {eye: [0, 0, 0]}, contact: []}
  keel: {mass: 12, inertia: [13, 10, 5], position: [7, 0, 0], attachments: {eye: [0, 0, 0]}, contact: [[0, 0, -2]]}
  bob: {mass: 12, position: [8, 0, 0], attachments: {eye: [0, 0, 0]}}
  ball: {mass: 12, position: [9, 0, 0], attachments: {eye: [0, 0, 0]}, volume: 4.1887902047863905}
cables:
  a: {type: rope, from: held, to: plain, elements: 1}
  b: {type: rope, from: plain, to: none, elements: 1}
  c: {type: rope, from: none, to: shoe, elements: 1}
  d: {type: rope, from: shoe, to: buoy, elements: 1}
  e: {type: rope, from: buoy, to: box.eye, elements: 1}
  f: {type: rope, from: box.eye, to: bare.eye, elements: 1}
  g: {type: rope, from: bare.eye, to: keel.eye, elements: 1}
  h: {type: rope, from: keel.eye, to: bob.eye, elements: 1}
  i: {type: rope, from: bob.eye, to: ball.eye, elements: 1}
)";
  const network::Network network = network_of("level: -2, stiffness: 150", text);
  const auto& spots = network.bed_spots;
  ASSERT_EQ(spots.size(), 8u + 1 + 1 + 2) << "bodies come first";
  // The box of this inertia has the edges 1, 2 and 3: m/12 times the sums of their squares.
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < 8; ++i) {
    const Vector3 corner = network.position[spots[i].node] - Vector3(5, 0, 0);
    EXPECT_LE((corner.cwiseAbs() - Vector3(0.5, 1, 1.5)).norm(), 1e-12);
    EXPECT_NEAR(spots[i].area, (2 + 6 + 3) / 3.0 / 4, 1e-12);
    EXPECT_EQ(spots[i].radius, 0);
    sum += corner;
  }
  EXPECT_LE(sum.norm(), 1e-12) << "each corner once";
  EXPECT_EQ(network.position[spots[8].node], Vector3(7, 0, -2));
  const auto expect_sphere = [&](std::size_t i, double x, double radius) {
    EXPECT_EQ(network.position[spots[i].node], Vector3(x, 0, 0));
    EXPECT_NEAR(spots[i].radius, radius, 1e-12);
    EXPECT_NEAR(spots[i].area, std::numbers::pi * radius * radius, 1e-12);
  };
  expect_sphere(9, 9, 1);
  expect_sphere(10, 3, 0.25);
  expect_sphere(11, 4, 1);
  EXPECT_TRUE(network::build_network(test::scene_of(chain)).bed_spots.empty());
}

/// A point and a body that lie 0.1 m deep, with the sphere's lowest place and with four corners of the box.
const std::string resting = R"(
points: {a: {position: [0, 0, 0], motion: fixed}, shoe: {position: [3, 0, -1.85], mass: 1, contact_radius: 0.25}}
bodies: {box: {mass: 12, inertia: [13, 10, 5], position: [5, 0, -0.6], attachments: {eye: [0, 0, 0]}}}
cables: {one: {type: rope, from: a, to: shoe, elements: 1}, other: {type: rope, from: shoe, to: box.eye, elements: 1}}
)";

network::Network without_spots(network::Network network) {
  network.bed_spots.clear();
  return network;
}

TEST(BedSpots, BearWhatPressesThem) {
  const network::Network whole = network_of("level: -2, stiffness: 1.0e4, friction: 0.3", resting);
  Field force[2];
  for (int i = 0; i < 2; ++i) {
    System system(i == 0 ? whole : without_spots(whole), {scene::Scheme::plain}, PETSC_COMM_WORLD);
    const Stages s(system, 0.5);
    const system::Vector r = system.assembler.make_vector();
    petsc::check(VecSet(s.a, 0));
    system.assembler.begin_step(0, s.x0, s.v0);
    EXPECT_TRUE(system.assembler.evaluate({.stage = {0, 0, 0}}, s.x0, s.v0, s.a, r, nullptr));
    force[i] = system.field(r);
  }
  const Field found = difference(force[1], force[0]);
  EXPECT_LE((found[whole.point_node[1]] - Vector3(0, 0, std::numbers::pi * 0.0625 * 1e3)).norm(), 1e-9);
  EXPECT_LE((found[whole.bodies[0].node] - Vector3(0, 0, 11.0 / 3 * 1e3)).norm(), 1e-9);
}

/// Loads are taken without the bed, on which points and bodies lie, too.
TEST(BedSpots, AreNoLoads) {
  const network::Network whole = network_of("level: -2, stiffness: 1.0e4, friction: 0.3", resting);
  Field loads[2];
  for (int i = 0; i < 2; ++i) {
    System system(i == 0 ? whole : without_spots(whole), {scene::Scheme::plain}, PETSC_COMM_WORLD);
    const Stages s(system, 0.5);
    solve::StaticForces forces(system.assembler, 0, Vector3::Zero());
    const system::Vector r = system.assembler.make_vector();
    forces.loads(s.x, r);
    loads[i] = system.field(r);
  }
  EXPECT_EQ(size(difference(loads[0], loads[1])), 0);
  EXPECT_GT(size(loads[0]), 0);
}

}   // namespace
}   // namespace cablenet::test
