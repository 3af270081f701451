#include "cablenet/solve/pretension.hpp"

#include <gtest/gtest.h>

#include "../support/networks.hpp"

using namespace cablenet;
using namespace cablenet::test;

namespace {

/// Two stays of given tensions at a mass, and a net of a given mean tension.
const std::string stayed = R"(
environment: {gravity: 9.81}
points:
  a: {position: [-8, 0, 0], motion: fixed}
  b: {position: [7, 3, 1], motion: fixed}
  m: {position: [0, 0, -2], mass: 5}
cables:
  one: {type: rope, from: a, to: m, tension: 130, elements: 8}
  two: {type: slack, from: m, to: b, tension: 128, elements: 9}
nets:
  panel: {type: rope, corners: [[0, 0, 9], [6, 0, 9], [6, 4, 9], [0, 4, 9]], meshes: [6, 4], prestress: 25,
    fixed: [top, right, bottom, left]}
initial: static
)";

}   // namespace

TEST(Pretension, LengthsGiveTheTensionsOnAnyNumberOfRanks) {
  std::vector<double> alone;
  for (const MPI_Comm communicator : {PETSC_COMM_SELF, PETSC_COMM_WORLD}) {
    System system(network_of(stayed), {}, communicator);
    ASSERT_EQ(system.network.pretensions.size(), 3u);
    solve::PretensionSearch search(system.assembler, system.network, 0, Vector3::Zero());
    EXPECT_TRUE(search.solve()) << search.failure();
    for (int i = 0; i < 3; ++i) {
      const double asked = system.network.pretensions[at(i)].tension;
      EXPECT_NEAR(search.tensions()(i), asked, 1e-8 * asked);
      EXPECT_NE(search.factors()[at(i)], 1);
      if (alone.empty()) continue;
      EXPECT_NEAR(search.factors()[at(i)], alone[at(i)], 1e-8);
    }
    alone = search.factors();
  }
}
