#include "cablenet/network/build.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "../support/networks.hpp"
#include "cablenet/base/errors.hpp"

using namespace cablenet;
using namespace cablenet::test;
using network::Network;
using network::Span;

namespace {

const Span& span_of(const Network& network, const std::string& name) {
  return *std::find_if(network.spans.begin(), network.spans.end(), [&](const Span& s) { return s.name == name; });
}

/// The nodes of a cable from end to end.
std::vector<SceneNode> nodes_of(const Network& network, const std::string& name) {
  const Span& span = span_of(network, name);
  std::vector<SceneNode> nodes{network.elements[at(span.first_element)].node[0]};
  for (int e = 0; e < span.elements; ++e) {
    const auto& element = network.elements[at(span.first_element + e)];
    EXPECT_EQ(element.node[0], nodes.back()) << name << " is torn at element " << e;
    nodes.push_back(element.node[1]);
  }
  return nodes;
}

/// The unstretched arc length of each node of a cable.
std::vector<double> arcs_of(const Network& network, const std::string& name) {
  const Span& span = span_of(network, name);
  std::vector<double> arcs{0};
  for (int e = 0; e < span.elements; ++e)
    arcs.push_back(arcs.back() + network.elements[at(span.first_element + e)].length);
  return arcs;
}

double arc_of_node(const Network& network, const std::string& name, SceneNode node) {
  const std::vector<SceneNode> nodes = nodes_of(network, name);
  return arcs_of(network, name)[at(static_cast<int>(std::find(nodes.begin(), nodes.end(), node) - nodes.begin()))];
}

void expect_refusal(const std::string& text, const std::vector<std::string>& parts) {
  try {
    network_of(text);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    for (const std::string& part : parts)
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

void expect_arcs(const Network& network, const std::string& name, const std::vector<double>& expected) {
  const std::vector<double> arcs = arcs_of(network, name);
  ASSERT_EQ(arcs.size(), expected.size());
  for (std::size_t i = 0; i < arcs.size(); ++i) EXPECT_NEAR(arcs[i], expected[i], 1e-12) << name << ", node " << i;
}

const std::string trunk = R"(
points:
  a: {position: [0, 0, 0], motion: fixed}
  b: {position: [10, 0, 0]}
  p: {position: [5, 0, -3]}
  q: {position: [5, 2, -3]}
  r: {position: [5, 4, -3]}
cables:
  trunk: {type: rope, from: a, to: b, elements: 10}
)";

}   // namespace

TEST(Build, ATapOnTheEvenGridChangesNothing) {
  const Network network = network_of(trunk + R"(
  one: {type: rope, from: {cable: trunk, at: 3}, to: p, elements: 2}
  two: {type: rope, from: q, to: {cable: trunk, at: 7}, elements: 2}
  three: {type: rope, from: {cable: trunk, at: 7}, to: r, elements: 2}
)");
  expect_arcs(network, "trunk", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
  EXPECT_EQ(nodes_of(network, "one").front(), nodes_of(network, "trunk")[3]);
  EXPECT_EQ(nodes_of(network, "two").back(), nodes_of(network, "trunk")[7]);
  EXPECT_EQ(nodes_of(network, "three").front(), nodes_of(network, "trunk")[7]);
  EXPECT_EQ(network.position.size(), 5u + 9u + 3u);
  EXPECT_EQ(network.elements.size(), 16u);
  EXPECT_EQ(network.element_name(12), "two, element 1 of 2");
}

TEST(Build, ATapOffTheGridSharesTheElementsOutAnew) {
  const Network network = network_of(trunk + R"(
  one: {type: rope, from: {cable: trunk, at: 3.2}, to: p, elements: 2}
  two: {type: rope, from: {cable: trunk, at: 3.2}, to: q, elements: 2}
  three: {type: rope, from: {cable: trunk, at: 9.9}, to: r, elements: 2}
)");
  for (const auto& [name, tap] : {std::pair{"one", 3.2}, {"two", 3.2}, {"three", 9.9}}) {
    const SceneNode node = nodes_of(network, name).front();
    EXPECT_NEAR(arc_of_node(network, "trunk", node), tap, 1e-12) << name;
    EXPECT_LE((network.position[node] - Vector3(tap, 0, 0)).norm(), 1e-12);
  }
  EXPECT_EQ(nodes_of(network, "trunk").size(), 11u);
  const std::vector<double> arcs = arcs_of(network, "trunk");
  EXPECT_NEAR(arcs.back(), 10, 1e-12);
  for (std::size_t i = 1; i < arcs.size(); ++i) {
    const double length = arcs[i] - arcs[i - 1];
    EXPECT_GT(length, 0);
    const bool after_tap = std::abs(arcs[i - 1] - 3.2) < 1e-9 || std::abs(arcs[i - 1] - 9.9) < 1e-9;
    EXPECT_TRUE(i == 1 || after_tap || std::abs(length - arcs[i - 1] + arcs[i - 2]) < 1e-12) << "element " << i;
  }
}

TEST(Build, TapsAtTheEndsAreTheEnds) {
  const Network network = network_of(trunk + R"(
  one: {type: rope, from: {cable: trunk, at: 0}, to: p, elements: 2}
  two: {type: rope, from: {cable: trunk, at: 10}, to: q, elements: 2}
  qr: {type: rope, from: q, to: r, elements: 1}
)");
  EXPECT_EQ(nodes_of(network, "one").front(), network.point_node[0]);
  EXPECT_EQ(nodes_of(network, "two").front(), network.point_node[1]);
  expect_arcs(network, "trunk", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
}

TEST(Build, EachStretchHasAnElement) {
  const std::string branches = R"(
points: {a: {position: [0, 0, 0], motion: fixed}, b: {position: [10, 0, 0]}, tip: {position: [0, 0, -3]}}
cables:
  branch: {type: rope, from: {cable: trunk, at: 0.1}, to: tip, elements: 2, repeat: {count: 3, every: 0.1, offset: [0.1, 0, 0]}}
  trunk: {type: rope, from: a, to: b, elements: )";
  expect_arcs(network_of(branches + "4}\n"), "trunk", {0, 0.1, 0.2, 0.3, 10});
  expect_arcs(network_of(branches + "5}\n"), "trunk", {0, 0.1, 0.2, 0.3, 5.15, 10});
  expect_refusal(branches + "3}\n", {"test.yaml:", "cables.trunk", "4 stretches", "3 elements"});
}

TEST(Build, ATapBeyondADefaultLengthIsRefused) {
  expect_refusal(trunk + R"(
  one: {type: rope, from: {cable: trunk, at: 10.1}, to: p, elements: 2}
  qr: {type: rope, from: q, to: r, elements: 1}
)",
                 {"test.yaml:", "cables.trunk", "10.1 m", "10 m"});
}

TEST(Build, NestedTapsMayReferForward) {
  const Network network = network_of(R"(
points: {a: {position: [0, 0, 0], motion: fixed}, b: {position: [10, 0, 0]}, p: {position: [4, 0, -3]}, q: {position: [4, 5, -1]}}
cables:
  twig: {type: rope, from: {cable: branch, at: 1}, to: q, elements: 3}
  branch: {type: rope, from: {cable: trunk, at: 4}, to: p, elements: 3}
  link: {type: slack, from: {cable: twig, at: 2}, to: {cable: trunk, at: 8}, elements: 2}
  trunk: {type: rope, from: a, to: b, elements: 10, length: 10}
)");
  const auto place = [&](const std::string& name, std::size_t k) {
    return network.position[nodes_of(network, name)[k]];
  };
  EXPECT_LE((place("branch", 0) - Vector3(4, 0, 0)).norm(), 1e-12);
  EXPECT_LE((place("twig", 0) - Vector3(4, 0, -1)).norm(), 1e-12);
  EXPECT_LE((place("link", 0) - Vector3(4, 2, -1)).norm(), 1e-12);
  EXPECT_LE((place("link", 2) - Vector3(8, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(network.spans[0].name, "twig");
  EXPECT_EQ(network.position.size(), 4u + 2 + 2 + 1 + 9);
  EXPECT_NEAR(arcs_of(network, "twig").back(), 5, 1e-12);
}

TEST(Build, ANetIsAGridHeldAtItsEdges) {
  const Network network = network_of(R"(
points: {end: {position: [2, 1, -9], mass: 4}}
cables: {hanger: {type: slack, from: {net: panel, node: [1, 3]}, to: end, elements: 3}}
nets:
  panel: {type: rope, corners: [[0, 1, 0], [8, 1, 0], [8, 1, -6], [0, 1, -6]], meshes: [4, 3], slack: 1.1, fixed: [top, right]}
)");
  EXPECT_EQ(network.position.size(), 1 + 20 + 2);
  EXPECT_EQ(network.elements.size(), 3u + 4u * 4 + 5u * 3);
  EXPECT_EQ(network.spans[0].name, "hanger");
  EXPECT_EQ(network.spans[1].elements, 31);
  EXPECT_EQ(network.spans[1].first_element, 3);
  const Table<SceneNode, bool> held = held_nodes(network);
  int on_edges = 0;
  for (SceneNode node(1); node.value() < 21; ++node) {
    const Vector3& x = network.position[node];
    EXPECT_EQ(held[node], x.z() > -1e-9 || x.x() > 8 - 1e-9) << "node " << node.value();
    on_edges += held[node] ? 1 : 0;
  }
  EXPECT_EQ(on_edges, 5 + 3);
  EXPECT_EQ(network.prescribed.size(), 8u);
  EXPECT_LE((network.position[nodes_of(network, "hanger").front()] - Vector3(2, 1, -6)).norm(), 1e-12);
  for (std::size_t e = 3; e < network.elements.size(); ++e) {
    const auto& [a, b] = network.elements[e].node;
    EXPECT_NEAR((network.position[b] - network.position[a]).norm(), 2, 1e-12);
    EXPECT_NEAR(network.elements[e].length, 2.2, 1e-12);
  }
}

TEST(Build, VelocitiesAreLinearBetweenTheEndsUnlessGiven) {
  const std::string points = R"(
points:
  a: {position: [0, 0, 0], motion: {velocity: [2, 0, 0]}}
  b: {position: [4, 0, 0], velocity: [0, 4, 0]}
  c: {position: [8, 0, 0]}
cables:
  ab: {type: rope, from: a, to: b, elements: 4}
)";
  const Network linear = network_of(points + "  bc: {type: rope, from: b, to: c, elements: 2}\n");
  const std::vector<SceneNode> nodes = nodes_of(linear, "ab");
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const double s = 0.25 * static_cast<double>(k);
    EXPECT_LE((linear.velocity[nodes[k]] - Vector3(2 - 2 * s, 4 * s, 0)).norm(), 1e-12);
  }
  EXPECT_LE((linear.velocity[nodes_of(linear, "bc")[1]] - Vector3(0, 2, 0)).norm(), 1e-12);
  const Network given = network_of(
      points + "  bc: {type: rope, from: b, to: c, elements: 2, node_velocity: [[0, 4, 0], [7, 8, 9], [1, 2, 3]]}\n");
  EXPECT_EQ(given.velocity[nodes_of(given, "bc")[1]], Vector3(7, 8, 9));
  EXPECT_EQ(given.velocity[given.point_node[2]], Vector3(1, 2, 3));
  expect_refusal(
      points + "  bc: {type: rope, from: b, to: c, elements: 2, node_velocity: [[0, 5, 0], [7, 8, 9], [1, 2, 3]]}\n",
      {"test.yaml:", "cables.bc", "node_velocity", "point b"});
}

/// The order in which the scene names its cables makes no difference.
TEST(Build, AVelocityFromAnotherCableIsThePointsOwn) {
  const std::string points = R"(
points: {a: {position: [0, 0, 0], motion: fixed}, b: {position: [4, 0, 0]}, c: {position: [8, 0, 0]}}
cables:
)";
  const std::string ab = "  ab: {type: rope, from: a, to: b, elements: 2}\n";
  const std::string bc =
      "  bc: {type: rope, from: b, to: c, elements: 2, node_velocity: [[0, 4, 0], [0, 5, 0], [0, 6, 0]]}\n";
  for (const std::string& cables : {bc + ab, ab + bc}) {
    const Network network = network_of(points + cables);
    EXPECT_EQ(network.velocity[nodes_of(network, "ab")[1]], Vector3(0, 2, 0)) << cables;
  }
}

TEST(Build, UnstretchedLengthsSumToTheCables) {
  const Network network = network_of(trunk + R"(
  one: {type: rope, from: {cable: trunk, at: 3.21}, to: p, elements: 7, length: 9.5, shape: catenary}
  two: {type: rope, from: {cable: one, at: 8.1}, to: q, elements: 5, length: 3.3}
  three: {type: rope, from: r, to: p, elements: 3}
)");
  EXPECT_NEAR(arcs_of(network, "trunk").back(), 10, 1e-12);
  EXPECT_NEAR(arcs_of(network, "one").back(), 9.5, 1e-12);
  EXPECT_NEAR(arcs_of(network, "two").back(), 3.3, 1e-12);
  EXPECT_NEAR(arcs_of(network, "three").back(), 4, 1e-12);
}

TEST(Build, CoincidentNodesAreRefused) {
  expect_refusal(R"(
points: {a: {position: [0, 0, 0], motion: fixed}, b: {position: [1, 0, 0]}}
cables: {fold: {type: rope, from: a, to: b, elements: 4, length: 4, shape: [[0, 0, 0], [1, 0, 0], [1, 0, 0], [2, 0, 0], [1, 0, 0]]}}
)",
                 {"test.yaml"});
  expect_refusal(R"(
points: {a: {position: [0, 0, 0], motion: fixed}, b: {position: [0, 0, 0]}}
cables: {fold: {type: rope, from: a, to: b, elements: 3, length: 4, shape: [[0, 0, 0], [3, 0, 0], [0, 0, 0]]}}
)",
                 {"test.yaml", "fold, element 2 of 3", "one point"});
}

TEST(Build, ANetworkThatIsHeldEverywhereIsRefused) {
  expect_refusal(R"(
points: {a: {position: [0, 0, 0], motion: fixed}, b: {position: [1, 0, 0], motion: {velocity: [1, 0, 0]}}}
cables: {c: {type: rope, from: a, to: b, elements: 1}}
)",
                 {"test.yaml", "every node is held"});
}

TEST(Build, MaterialsAndLoadsAreTheScenes) {
  const Network network = network_of(R"(
points:
  a: {position: [0, 0, 0], motion: fixed, mass: 1}
  b: {position: [1, 0, 0], force: [1, 2, 3]}
  c: {position: [2, 0, 0]}
cables: {ab: {type: damped, from: a, to: b, elements: 1}, bc: {type: slack, from: b, to: c, elements: 1}}
)");
  const elements::CableMaterial& damped = network.materials[at(network.elements[0].material)];
  EXPECT_EQ(damped.axial_stiffness, 1000);
  EXPECT_DOUBLE_EQ(damped.axial_damping, 8 + 2e-3 * 1000);
  EXPECT_EQ(damped.mass_per_length, 0.4);
  EXPECT_EQ(damped.mass_damping, 0.7);
  EXPECT_FALSE(damped.tension_only);
  EXPECT_TRUE(network.materials[at(network.elements[1].material)].tension_only);
  EXPECT_DOUBLE_EQ(network.gravity, 9.80665);
  ASSERT_EQ(network.loads.size(), 2u);
  EXPECT_EQ(network.loads[0].mass, 1);
  EXPECT_EQ(network.loads[1].force, Vector3(1, 2, 3));
}
