#include "cablenet/output/shape_record.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../support/networks.hpp"

using namespace cablenet;
using namespace cablenet::test;

namespace {

constexpr double pi = std::numbers::pi;

const std::string chains = R"(
environment: {gravity: 0}
points:
  a: {position: [0, 0, 0]}
  b: {position: [12, 0, 0]}
  c: {position: [12, 0, 5]}
bodies:
  tail: {mass: 1, inertia: [1, 1, 1], position: [0, 3, 0], attachments: {eye: [0, 0, 0]}}
  lump: {mass: 1, position: [0, 4, 0], attachments: {eye: [0, 0, 0]}}
cables:
  arc: {type: rope, from: a, to: b, elements: 12}
  straight: {type: rope, from: b, to: c, elements: 5}
  branch: {type: rope, from: {cable: arc, at: 4}, to: tail.eye, elements: 2}
  bar: {type: rope, from: a, to: lump.eye, elements: 1}
output: {interval: 0.1}
)";

class Shapes : public testing::Test {
protected:
  Shapes() : record_(network_, 4, system_.assembler.network(), PETSC_COMM_WORLD), x_(network_.position) {}

  /// The nodes of a span from end to end.
  std::vector<SceneNode> nodes(std::size_t span) const {
    std::vector<SceneNode> nodes;
    const network::Span& all = network_.spans[span];
    for (int i = 0; i < all.elements; ++i) nodes.push_back(network_.elements[at(all.first_element + i)].node[0]);
    nodes.push_back(network_.elements[at(all.first_element + all.elements - 1)].node[1]);
    return nodes;
  }

  void look() {
    const Field rest(network_.position.size(), Vector3::Zero());
    record_.look(system_.assembler.observe(0, system_.vector(x_), system_.vector(rest), system_.vector(rest)));
  }

  network::Network network_ = network_of(chains);
  System system_{network_, {}, PETSC_COMM_WORLD};
  output::ShapeRecord record_;
  Field x_;
};

}   // namespace

TEST_F(Shapes, AnArcHasItsSagAndItsHeight) {
  const std::vector<SceneNode> arc = nodes(0);
  const double radius = 10, step = 0.1;
  for (std::size_t i = 0; i < arc.size(); ++i) {
    const double angle = step * (static_cast<double>(i) - 6);
    x_[arc[i]] = {radius * std::sin(angle), radius * std::cos(angle), 7};
  }
  look();
  const output::ShapeSummary found = record_.summary();
  EXPECT_EQ(found.instants, 1);
  const output::CableShape& shape = found.cables[0];
  EXPECT_EQ(shape.nodes, 10) << "eleven inner nodes, one of them a tap";
  const double chord = 2 * radius * std::sin(step / 2);
  EXPECT_NEAR(shape.sag, chord * 2 * std::sin(step / 2) / 8, 1e-12);
  EXPECT_NEAR(shape.deviation, radius * (1 - std::cos(0.6)), 1e-12);
  EXPECT_NEAR(shape.strain, 1 - chord, 1e-12);
  EXPECT_NEAR(shape.jump, 0, 1e-12);
  EXPECT_EQ(shape.lowest, 7);
  EXPECT_EQ(shape.highest, 7);
  EXPECT_EQ(found.lowest, 0);
  EXPECT_EQ(found.highest, 7);
  EXPECT_EQ(found.cables[1].nodes, 4);
  EXPECT_EQ(found.cables[3].nodes, 0) << "one element";
}

TEST_F(Shapes, WhatMovesAsAWholeHasNoMotionOfItsOwn) {
  look();
  for (int i = 0; i < 3; ++i) {
    for (Vector3& x : x_) x += Vector3(1000, -500, 20);
    look();
  }
  for (const output::CableShape& shape : record_.summary().cables) {
    EXPECT_LT(shape.motion, 1e-5);
    EXPECT_LT(shape.bending, 1e-11);
    EXPECT_LT(shape.wobble, 1e-11);
  }
}

TEST_F(Shapes, MeansAreOverTimeAndNodes) {
  const std::vector<SceneNode> straight = nodes(1);
  look();
  // One of four inner nodes goes sideways by 0.3: from its mean place by 0.15 at both instants.
  x_[straight[2]].y() += 0.3;
  look();
  const output::CableShape shape = record_.summary().cables[1];
  EXPECT_NEAR(shape.motion, 0.15 / 2, 1e-12);
  EXPECT_NEAR(shape.deviation, 0.3, 1e-12);
  const double length = std::hypot(1.0, 0.3), s = 0.3 / length;
  // The sags at the instants: none, and those at the node and at its two neighbours.
  const Vector3 up(0, s, 1 / length), along(0, 0, 1), down(0, -s, 1 / length);
  const double at_node = 2 * length / 16 * (down - up).norm(), beside = (1 + length) / 16 * (up - along).norm();
  const double squares = at_node * at_node + 2 * beside * beside;
  EXPECT_NEAR(shape.sag, std::sqrt(squares / 8), 1e-12);
  EXPECT_NEAR(shape.bending, std::sqrt(squares / 16), 1e-12) << "a half of it, from the mean, at both instants";
  const double strain = length - 1;
  EXPECT_NEAR(shape.strain, strain * std::sqrt(2.0 / 10), 1e-12);
  EXPECT_NEAR(shape.jump, strain * std::sqrt(2.0 / 8), 1e-12);
  EXPECT_NEAR(shape.wobble, strain * std::sqrt(2.0 / 16), 1e-12);
}

TEST_F(Shapes, OfManyInstantsEverySecondOneIsLookedAt) {
  for (int i = 0; i < 100; ++i) look();
  EXPECT_EQ(record_.summary().instants, 64 + 18);
}

TEST_F(Shapes, ABodyIsTurnedFromWhereItIsDrawn) {
  const system::Vector x = system_.vector(x_), rest = system_.vector(Field(x_.size(), Vector3::Zero()));
  const partition::LocalNetwork& here = system_.assembler.network();
  double* values = nullptr;
  ASSERT_EQ(VecGetArray(x, &values), 0);
  for (int b = 0; b < here.own_bodies; ++b) {
    if (here.bodies[at(b)].properties.rotation == bodies::Rotation::none) continue;
    double* const q = values + here.begin[here.bodies[at(b)].node].value() + 3;
    q[0] = std::cos(pi / 8), q[1] = 0, q[2] = std::sin(pi / 8), q[3] = 0;
  }
  ASSERT_EQ(VecRestoreArray(x, &values), 0);
  record_.look(system_.assembler.observe(0, x, rest, rest));
  const output::ShapeSummary found = record_.summary();
  EXPECT_NEAR(found.turned[0], pi / 4, 1e-12);
  EXPECT_EQ(found.turned[1], 0);
}
