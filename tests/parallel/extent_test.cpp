#include <gtest/gtest.h>

#include <fmt/format.h>

#include "../support/networks.hpp"
#include "cablenet/solve/relaxation.hpp"
#include "cablenet/solve/statics.hpp"

using namespace cablenet;
using namespace cablenet::test;

namespace {

/// Three bars that are drawn stretched.  They can stand on their supports in compression, or hang from them.
std::string frame(double offset) {
  const auto point = [&](double x, double y, double z) { return fmt::format("[{}, {}, {}]", offset + x, y, z); };
  const std::string bar = "{type: rope, to: top, elements: 1, length: 3.4, from: ";
  return fmt::format(R"(
environment: {{gravity: 9.81}}
points:
  a: {{position: {}, motion: fixed}}
  b: {{position: {}, motion: fixed}}
  c: {{position: {}, motion: fixed}}
  top: {{position: {}, mass: 1}}
cables: {{one: {}a}}, two: {}b}}, three: {}c}}}}
)",
                     point(0, 0, 0), point(4, 0, 0), point(2, 3, 0), point(2, 1, 3), bar, bar, bar);
}

/// The height of the weight at rest [m].
double height_at_rest(double offset) {
  System system(network_of(frame(offset)), {}, PETSC_COMM_WORLD);
  solve::Statics statics(system.assembler, 0, Vector3::Zero());
  EXPECT_TRUE(statics.solve()) << statics.failure();
  return system.field(statics.position())[SceneNode(3)].z();
}

}   // namespace

TEST(Extent, IsTheSameOnAllRanksAndAnywhere) {
  for (const double offset : {0.0, 5e5}) {
    const network::Network network = network_of(frame(offset));
    EXPECT_NEAR(network.extent(), std::sqrt(4.0 * 4 + 3 * 3 + 3 * 3), 1e-9);
    for (const MPI_Comm communicator : {PETSC_COMM_SELF, PETSC_COMM_WORLD}) {
      System system(network, {}, communicator);
      EXPECT_EQ(system.assembler.network().extent, network.extent());
      EXPECT_EQ(solve::relaxation_tolerance(system.assembler.network()), 1e-3 * network.extent());
    }
  }
}

TEST(Extent, StaticsComesToTheSameEquilibriumFarFromTheOrigin) {
  const double here = height_at_rest(0);
  EXPECT_LT(here, -2) << "not what was drawn, so the frame hangs";
  EXPECT_NEAR(height_at_rest(5e5), here, 1e-6);
}
