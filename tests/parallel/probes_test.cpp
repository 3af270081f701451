#include "cablenet/output/probes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "../support/networks.hpp"
#include "cablenet/elements/cable.hpp"

using namespace cablenet;
using namespace cablenet::test;

namespace {

/// A scene and its system on all ranks.  The row of a state is a map from column names, the same on every rank.
class Observed {
public:
  explicit Observed(const std::string& text)
      : scene_(scene_of(text)), system_(network::build_network(scene_), {}, PETSC_COMM_WORLD) {}

  const network::Network& network() const { return system_.network; }

  std::map<std::string, double> row(double t, const Field& x, const Field& v, const Field& a) {
    output::Probes probes(scene_, system_.network, system_.assembler);
    std::vector<double> row =
        probes.row(system_.assembler.observe(t, system_.vector(x), system_.vector(v), system_.vector(a)));
    MPI_Bcast(row.data(), static_cast<int>(row.size()), MPI_DOUBLE, 0, PETSC_COMM_WORLD);
    std::map<std::string, double> values;
    for (std::size_t i = 0; i < row.size(); ++i) values[probes.columns().at(i)] = row[i];
    EXPECT_EQ(values.size(), probes.columns().size());
    return values;
  }

private:
  scene::Scene scene_;
  System system_;
};

Vector3 vector_of(const std::map<std::string, double>& row, const std::string& point, const std::string& kind) {
  return {row.at(point + "." + kind + "x"), row.at(point + "." + kind + "y"), row.at(point + "." + kind + "z")};
}

const std::string hanging = R"(
environment: {gravity: 9.81}
points:
  top: {position: [1, 2, 0], motion: fixed, mass: 0.7}
  tip: {position: [1, 2, -6], mass: 2}
cables: {chain: {type: rope, from: top, to: tip, elements: 6, length: 6}}
time: {end: 1, step: 0.1}
output: {history: [top, tip, chain], energy: true}
)";

const std::string moving = R"(
environment: {gravity: 0}
points:
  tow: {position: [1, 0, 0], motion: {harmonic: {amplitude: [0.1, 0.2, 0.3], period: 2, phase: 30}}}
  lone: {position: [0, 9, 0], motion: {velocity: [1, 2, 3]}, mass: 2, force: [5, 0, 0]}
  tail: {position: [9, 0, 0], velocity: [1, 0, 0]}
  tip: {position: [3, 0, -3], mass: 1, force: [0, 0, 1]}
cables:
  trunk: {type: damped, from: tow, to: tail, elements: 8, length: 8}
  branch: {type: rope, from: {cable: trunk, at: 2}, to: tip, elements: 3}
  single: {type: slack, from: tail, to: tip, elements: 1, length: 9}
time: {start: 0.25, end: 1, step: 0.1}
output: {history: [tip, tow, trunk, tail, branch, single, lone]}
)";

}   // namespace

TEST(Probes, AHangingChainAtRest) {
  Observed chain(hanging);
  const Field zero(chain.network().position.size(), Vector3::Zero());
  Field x = chain.network().position;
  const double weight = 0.5 * 9.81, EA = 2000;   // the weight of one element
  double strain = 0, gravity = 0;
  for (int e = 0; e < 6; ++e) {
    const auto& [above, below] = chain.network().elements[at(e)].node;
    const double tension = 2 * 9.81 + weight * (6 - e - 0.5);
    x[below] = x[above] - Vector3(0, 0, 1 + tension / EA);
    strain += 0.5 * tension * tension / EA;
    gravity += 0.5 * weight * (x[above] + x[below]).z();
  }
  const SceneNode tip = chain.network().point_node[1];
  gravity += 2 * 9.81 * x[tip].z();
  auto row = chain.row(0.5, x, zero, zero);
  EXPECT_EQ(row.at("time"), 0.5);
  EXPECT_LE((vector_of(row, "top", "f") - Vector3(0, 0, 6 * weight + 2.7 * 9.81)).norm(), 1e-9);
  EXPECT_EQ(vector_of(row, "top", ""), Vector3(1, 2, 0));
  EXPECT_EQ(vector_of(row, "tip", ""), x[tip]);
  EXPECT_NEAR(row.at("chain.tension_from"), 6 * weight + 2 * 9.81, 1e-9);
  EXPECT_NEAR(row.at("chain.tension_to"), 2 * 9.81, 1e-9);
  EXPECT_EQ(row.at("energy.kinetic"), 0);
  EXPECT_NEAR(row.at("energy.strain"), strain, 1e-12 * strain);
  EXPECT_NEAR(row.at("energy.gravity"), gravity, 1e-12 * std::abs(gravity));
  EXPECT_EQ(row.at("energy.work"), 0);
  EXPECT_NEAR(row.at("energy.total"), strain + gravity, 1e-12 * std::abs(gravity));
  for (const char* account : {"dissipated", "damping", "water", "bed", "balance"})
    EXPECT_EQ(row.at(std::string("energy.") + account), 0) << account;
  EXPECT_EQ(row.size(), 1u + 12 + 9 + 2 + 10);
}

TEST(Probes, KinematicsAreTheObservedState) {
  Observed scene(moving);
  const int nodes = scene.network().position.size();
  const Field zero(nodes, Vector3::Zero());
  const Field x = disturbed(scene.network().position, 0.3, 1);
  const Field v = disturbed(zero, 2, 1000), a = disturbed(zero, 9, 2000);
  const double t = 0.75;
  auto row = scene.row(t, x, v, a);
  for (const auto& [name, point] : {std::pair{"tip", 3}, {"tail", 2}}) {
    const SceneNode node = scene.network().point_node[at(point)];
    EXPECT_EQ(vector_of(row, name, ""), x[node]) << name;
    EXPECT_EQ(vector_of(row, name, "v"), v[node]) << name;
    EXPECT_EQ(vector_of(row, name, "a"), a[node]) << name;
    EXPECT_FALSE(row.contains(std::string(name) + ".fx"));
  }
  const Vector3 amplitude(0.1, 0.2, 0.3);
  const double w = std::numbers::pi, angle = w * t + std::numbers::pi / 6;
  EXPECT_LE((vector_of(row, "tow", "") - Vector3(1, 0, 0) - amplitude * std::sin(angle)).norm(), 1e-12);
  EXPECT_LE((vector_of(row, "tow", "v") - amplitude * w * std::cos(angle)).norm(), 1e-12);
  EXPECT_LE((vector_of(row, "tow", "a") + amplitude * w * w * std::sin(angle)).norm(), 1e-12);
  EXPECT_LE((vector_of(row, "lone", "") - Vector3(0.5, 10, 1.5)).norm(), 1e-12);
  EXPECT_LE((vector_of(row, "lone", "f") - Vector3(-5, 0, 0)).norm(), 1e-12);
}

TEST(Probes, EndTensionsAreWhatPullsAtTheEnds) {
  Observed scene(moving);
  const network::Network& network = scene.network();
  const Field zero(network.position.size(), Vector3::Zero());
  Field x = disturbed(network.position, 0.3, 1), v = disturbed(zero, 2, 1000), a = disturbed(zero, 9, 2000);
  auto row = scene.row(0.75, x, v, a);
  for (const auto& [node, motion] : network.prescribed) {
    const scene::Kinematics held = motion.at(0.75);
    x[node] = held.x, v[node] = held.v, a[node] = held.a;
  }
  Vector3 at_tow = Vector3::Zero();
  for (const auto& [name, first, elements] : network.spans)
    for (int side = 0; side < 2; ++side) {
      const network::Element& e = network.elements[at(side == 0 ? first : first + elements - 1)];
      const auto& material = network.materials[at(e.material)];
      const SceneNode i = e.node[0], j = e.node[1];
      const elements::Chord chord{x[j] - x[i], v[j] - v[i]};
      const auto forces = elements::cable_end_forces(
          material, e.length, 0, chord, {a[i] + material.mass_damping * v[i], a[j] + material.mass_damping * v[j]});
      const double size = (side == 0 ? forces.on1 : forces.on2).norm();
      const double sign = elements::cable_tension(material, e.length, chord) < 0 ? -1 : 1;
      EXPECT_NEAR(row.at(name + (side == 0 ? ".tension_from" : ".tension_to")), sign * size, 1e-10 * size) << name;
      if (e.node[at(side)] == network.point_node[0]) at_tow = forces.on1;
    }
  EXPECT_GT(at_tow.norm(), 0);
  EXPECT_LE((vector_of(row, "tow", "f") - at_tow).norm(), 1e-10 * at_tow.norm());
}

TEST(Probes, ABareEndHasNoTension) {
  Observed scene(R"(
points: {top: {position: [0, 0, 0], motion: fixed}, tip: {position: [0, 0, -3]}, free: {position: [3, 0, 0]}}
cables:
  hanging: {type: rope, from: top, to: tip, elements: 3, length: 2.9}
  turned: {type: rope, from: free, to: top, elements: 1, length: 2.9}
time: {end: 1, step: 0.1}
output: {history: [hanging, turned, top]}
)");
  const Field zero(scene.network().position.size(), Vector3::Zero());
  auto row = scene.row(0, scene.network().position, zero, zero);
  EXPECT_EQ(row.at("hanging.tension_to"), 0);
  EXPECT_EQ(row.at("turned.tension_from"), 0);
  EXPECT_GT(row.at("hanging.tension_from"), 50);
  EXPECT_GT(row.at("turned.tension_to"), 50);
  const double pull = 2000 * 0.1 / 2.9;
  EXPECT_LE((vector_of(row, "top", "f") - Vector3(-pull, 0, pull + 9.80665 * (0.25 * 2.9 + 0.25 * 2.9 / 3))).norm(),
            1e-9);
}
