#include <gtest/gtest.h>

#include <limits>

#include "../support/stages.hpp"

/// Forces on points that depend on time, in the assembled residual.
namespace cablenet::test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// A line with a free end, a point between two cables and a moved one, each of which may get a force.
network::Network line(const std::string& tip, const std::string& middle, const std::string& moved) {
  return network_of(
      "points:\n"
      "  moved: {position: [0, 0, 0], motion: {velocity: [0.3, 0, 1]}" +
      moved +
      "}\n"
      "  middle: {position: [3, 0, -1], mass: 2" +
      middle +
      "}\n"
      "  tip: {position: [5, 1, -2]" +
      tip +
      "}\n"
      "cables:\n"
      "  upper: {type: rope, from: moved, to: middle, elements: 4}\n"
      "  lower: {type: damped, from: middle, to: tip, elements: 3}\n");
}

const std::string at_tip = ", force: {expression: {x: 2*t, z: \"-3\"}}";
const std::string in_middle = ", force: {waypoints: [[0, 0, 0, 0], [0.2, 0, 4, 0], [1, 0, 4, 0]]}";

class PointForce : public testing::TestWithParam<scene::Scheme> {
protected:
  system::ForceRule rule_{GetParam()};
};

TEST_P(PointForce, IsTheLawAtTheStage) {
  System with(line(at_tip, in_middle, ""), rule_, PETSC_COMM_WORLD);
  System without(line("", "", ""), rule_, PETSC_COMM_WORLD);
  const Stages s(with, 0.6), same(without, 0.6);
  with.assembler.begin_step(s.stage.t, s.x0, s.v0);
  without.assembler.begin_step(s.stage.t, same.x0, same.v0);
  const system::Vector r = residual_at(with, s, 0), rest = residual_at(without, same, 0);
  const double scale = largest(r), t = s.stage.time();
  petsc::check(VecAXPY(r, -1, rest));
  const Field load = with.field(r);
  ASSERT_LT(t, 0.2);
  for (SceneNode node(0); node.value() < load.size(); ++node) {
    Vector3 expected(0, 0, 0);
    if (node == with.network.point_node[1]) expected = Vector3(0, -4 * t / 0.2, 0);
    if (node == with.network.point_node[2]) expected = Vector3(-2 * t, 0, 3);
    EXPECT_LE((load[node] - expected).norm(), 16 * eps * scale) << "node " << node.value();
  }
}

TEST_P(PointForce, LeavesTheTangentAlone) {
  System system(line(at_tip, in_middle, ""), rule_, PETSC_COMM_WORLD);
  const Stages s(system, 0.6);
  system.assembler.begin_step(s.stage.t, s.x0, s.v0);
  system::TangentMatrix tangent = system.assembler.make_tangent();
  system.assembler.tangent(s.stage, s.x, s.v, s.a, {tangent, {1, s.shift_v, s.shift_a}});
  tangent.publish();
  EXPECT_LE(relative_difference(times_direction(system, s, tangent), slope(system, s, 1e-5)), 3e-8);
}

INSTANTIATE_TEST_SUITE_P(Schemes, PointForce,
                         testing::Values(scene::Scheme::energy_momentum, scene::Scheme::generalized_alpha,
                                         scene::Scheme::plain),
                         [](const auto& item) { return scene::name_of(item.param); });

/// At a point that is moved the force joins the reaction, and at a free end it makes a tension.
TEST(PointForceAtRest, ActsOnWhatHoldsAPoint) {
  System system(line("", "", ", force: {waypoints: [[0, 1, 2, 3], [1, 3, 2, 3]]}"), {}, PETSC_COMM_WORLD);
  const system::Vector x = system.assembler.make_vector(), v = system.assembler.make_vector();
  system.assembler.fill_initial(x, v);
  system.assembler.observe(0.25, x, v, v);
  const partition::LocalNetwork& here = system.assembler.network();
  for (LocalNode node(0); node.value() < here.nodes; ++node)
    if (here.primary[node] && here.scene_node[node] == system.network.point_node[0]) {
      EXPECT_EQ(system.assembler.node_force(node), Vector3(-1.5, -2, -3));
    }
}

}   // namespace
}   // namespace cablenet::test
