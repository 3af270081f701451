#include <gtest/gtest.h>

#include "../support/networks.hpp"
#include "cablenet/system/assembler.hpp"

using namespace cablenet;
using namespace cablenet::test;

namespace {

const std::string falling = R"(
environment: {gravity: 9.81}
points:
  a: {position: [0, 0, 0], mass: 2}
  b: {position: [9, 0, 1], mass: 3, force: [1, 2, 3]}
  c: {position: [4, 5, 2]}
cables:
  ab: {type: rope, from: a, to: b, elements: 7, length: 8}
  side: {type: damped, from: {cable: ab, at: 3}, to: c, elements: 5}
)";

/// Per node: half the mass of each of its elements, and the point mass.
Table<SceneNode, double> lumped_mass(const network::Network& network) {
  Table<SceneNode, double> mass(network.position.size(), 0);
  for (const auto& e : network.elements)
    for (const SceneNode node : e.node)
      mass[node] += 0.5 * network.materials[at(e.material)].mass_per_length * e.length;
  for (const auto& load : network.loads) mass[load.node] += load.mass;
  return mass;
}

double energy(const system::Assembler& assembler, double system::Energies::*kind) {
  return sum_over_ranks(assembler.energies().*kind);
}

}   // namespace

class AssemblerFalling : public testing::Test {
protected:
  network::Network network_ = network_of(falling);
  System system_{network_, {}, PETSC_COMM_WORLD};
  Field zero_ = Field(network_.position.size(), Vector3::Zero());
};

TEST_F(AssemblerFalling, TheMassMatrixHoldsTheMassAndTheKineticEnergy) {
  system::TangentMatrix mass = system_.assembler.make_tangent();
  system_.assembler.mass_matrix(0, system_.vector(network_.position), system_.vector(zero_), mass);
  mass.publish();
  const system::Vector product = system_.assembler.make_vector();
  petsc::check(MatMult(mass.matrix(), system_.vector(Field(zero_.size(), Vector3::Ones())), product));
  const Field row_sums = system_.field(product);
  const Table<SceneNode, double> lumped = lumped_mass(network_);
  for (SceneNode node(0); node.value() < lumped.size(); ++node)
    EXPECT_LE((row_sums[node] - lumped[node] * Vector3::Ones()).norm(), 1e-13) << "node " << node.value();
  const Field speed = disturbed(zero_, 5, 1);
  const system::Vector v = system_.vector(speed);
  PetscScalar twice = 0;
  petsc::check(MatMult(mass.matrix(), v, product));
  petsc::check(VecDot(v, product, &twice));
  system_.assembler.observe(0, system_.vector(network_.position), v, system_.vector(zero_));
  const double kinetic = energy(system_.assembler, &system::Energies::kinetic);
  EXPECT_GT(twice, 0);
  EXPECT_NEAR(twice, 2 * kinetic, 1e-13 * twice);
  PetscBool symmetric = PETSC_FALSE;
  petsc::check(MatIsSymmetric(mass.matrix(), 0, &symmetric));
  EXPECT_EQ(symmetric, PETSC_TRUE);
}

TEST_F(AssemblerFalling, TheEnergiesAreTheirFormulas) {
  const Field x = disturbed(network_.position, 0.5, 77);
  const Field v = disturbed(zero_, 2, 99);
  system_.assembler.observe(0, system_.vector(x), system_.vector(v), system_.vector(zero_));
  double strain = 0, gravity = 0, work = 0;
  for (const auto& e : network_.elements) {
    const auto& material = network_.materials[at(e.material)];
    const Vector3 d = x[e.node[1]] - x[e.node[0]];
    const double stretch = d.norm() / e.length - 1;
    strain += 0.5 * material.axial_stiffness * e.length * stretch * stretch;
    gravity += 9.81 * material.mass_per_length * e.length * 0.5 * (x[e.node[0]] + x[e.node[1]]).z();
  }
  for (const auto& load : network_.loads) {
    gravity += load.mass * 9.81 * x[load.node].z();
    work += load.force.dot(x[load.node] - network_.position[load.node]);
  }
  const double kinetic = energy(system_.assembler, &system::Energies::kinetic);
  EXPECT_NEAR(energy(system_.assembler, &system::Energies::strain), strain, 1e-12 * strain);
  EXPECT_NEAR(energy(system_.assembler, &system::Energies::gravity), gravity, 1e-12 * std::abs(gravity));
  EXPECT_NEAR(energy(system_.assembler, &system::Energies::work), work, 1e-12 * std::abs(work));
  const system::Energies mine = system_.assembler.energies();
  EXPECT_NEAR(sum_over_ranks(mine.total()), kinetic + strain + gravity - work, 1e-12 * (kinetic + strain));
}

TEST(AssemblerForce, AHangingChainPullsWithItsWeight) {
  const network::Network network = network_of(R"(
environment: {gravity: 9.81}
points: {top: {position: [0, 0, 0], motion: fixed}, tip: {position: [0, 0, -6], mass: 2, force: [1, 0, 4]}}
cables: {chain: {type: rope, from: top, to: tip, elements: 6}}
)");
  System system(network, {}, PETSC_COMM_WORLD);
  const Field zero(network.position.size(), Vector3::Zero());
  const system::Vector force = system.assembler.make_vector();
  system.assembler.force(0, system.vector(network.position), system.vector(zero), force);
  const Field unstrained = system.field(force);
  const Table<SceneNode, double> mass = lumped_mass(network);
  const SceneNode tip = network.point_node[1];
  Field at_rest = network.position;
  double tension = 2 * 9.81 - 4;
  for (SceneNode node(1); node.value() < mass.size(); ++node) {
    const Vector3 load = node == tip ? Vector3(1, 0, 4) : Vector3(0, 0, 0);
    EXPECT_LE((unstrained[node] - Vector3(0, 0, -9.81 * mass[node]) - load).norm(), 1e-12) << "node " << node.value();
  }
  // The stretched lengths are found from the tip upwards.  Only the sideways force at the tip is not in balance then.
  std::vector<double> stretched(network.elements.size());
  for (std::size_t e = stretched.size(); e-- > 0;)
    stretched[e] = 1 + ((tension += 0.5 * 0.5 * 9.81), tension) / 2000, tension += 0.5 * 0.5 * 9.81;
  for (std::size_t e = 0; e < stretched.size(); ++e)
    at_rest[network.elements[e].node[1]] = at_rest[network.elements[e].node[0]] - Vector3(0, 0, stretched[e]);
  system.assembler.force(0, system.vector(at_rest), system.vector(zero), force);
  Field left = system.field(force);
  left[tip].x() -= 1;
  EXPECT_LE(size(left), 1e-9);
}
