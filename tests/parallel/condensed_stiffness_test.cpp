#include "cablenet/solve/condensed_stiffness.hpp"

#include <gtest/gtest.h>

#include "../support/networks.hpp"
#include "cablenet/solve/statics.hpp"

using namespace cablenet;
using namespace cablenet::test;

namespace {

using Matrix = solve::CondensedStiffness::Matrix;

/// A hanging net, a body on two cables that hang from it, and a place that holds one of its corners.
const std::string hung = R"(
environment: {gravity: 9.81}
points: {corner: {position: [6, 0, -4], motion: fixed}, low: {position: [2, 1, -9], mass: 0.5}}
bodies:
  box: {mass: 4, inertia: [0.1, 0.2, 0.3], position: [3, 0, -9], attachments: {left: [-0.4, 0, 0.2], right: [0.4, 0.1, 0.2]}}
cables:
  one: {type: rope, from: {net: panel, node: [2, 4]}, to: box.left, elements: 5}
  two: {type: rope, from: {net: panel, node: [4, 4]}, to: box.right, elements: 5}
  stay: {type: rope, from: {net: panel, node: [6, 4]}, to: corner, length: 0.5, elements: 2, shape: [[6, 0, -4], [6.1, 0.1, -4], [6, 0, -4]]}
  tail: {type: rope, from: {cable: one, at: 2.5}, to: low, elements: 3}
nets: {panel: {type: rope, corners: [[0, 0, 0], [6, 0, 0], [6, 0, -4], [0, 0, -4]], meshes: [6, 4], fixed: [top]}}
)";

/// In equilibrium, that of the scene's points and of the box.
std::vector<Matrix> stiffness_on(MPI_Comm communicator) {
  const network::Network network = network_of(hung);
  System system(network, {}, communicator);
  solve::Statics statics(system.assembler, 0, Vector3::Zero());
  EXPECT_TRUE(statics.solve()) << statics.failure();
  statics.make_start();
  const std::vector<SceneNode> nodes{network.point_node[0], network.point_node[1], network.bodies[0].node};
  solve::CondensedStiffness stiffness(solve::at_start_of(network, system.assembler), nodes, {}, 0, Vector3::Zero(),
                                      communicator);
  std::vector<Matrix> all;
  for (const SceneNode node : nodes) all.push_back(stiffness.of(node).value_or(Matrix()));
  return all;
}

}   // namespace

TEST(CondensedStiffness, IsTheSameOnAllRanksAndSymmetricWithoutAFlow) {
  const std::vector<Matrix> alone = stiffness_on(PETSC_COMM_SELF), together = stiffness_on(PETSC_COMM_WORLD);
  ASSERT_EQ(alone.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(together[i].rows(), i < 2 ? 3 : 6);
    const double size = alone[i].cwiseAbs().maxCoeff();
    EXPECT_GT(size, 0);
    EXPECT_LE((alone[i] - together[i]).cwiseAbs().maxCoeff(), 1e-7 * size) << i;
    EXPECT_LE((alone[i] - alone[i].transpose()).cwiseAbs().maxCoeff(), 1e-7 * size) << i;
  }
}
