#pragma once
#include <petscsys.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "cablenet/network/build.hpp"
#include "cablenet/partition/local_network.hpp"
#include "cablenet/partition/partition.hpp"
#include "cablenet/scene/read.hpp"
#include "cablenet/system/assembler.hpp"

/// Tests make scenes from text, and networks of them on any communicator.  Nodal fields are in the scene's numbering,
/// so that runs on different numbers of ranks can be compared.
namespace cablenet::test {

/// A vector per scene node.
using Field = Table<SceneNode, Vector3>;

inline int rank_of(MPI_Comm communicator) {
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  return rank;
}

inline int size_of(MPI_Comm communicator) {
  int size = 1;
  MPI_Comm_size(communicator, &size);
  return size;
}

/// A scene of the sections in `text`, with three cable types: a rope, one that is slack in compression, and a damped
/// one.
inline scene::Scene scene_of(const std::string& text) {
  const std::string types =
      "cable_types:\n"
      "  rope: {mass_per_length: 0.5, axial_stiffness: 2000}\n"
      "  slack: {mass_per_length: 0.3, axial_stiffness: 1500, tension_only: true}\n"
      "  damped: {mass_per_length: 0.4, axial_stiffness: 1000, axial_damping: 8, rayleigh: {mass: 0.7, stiffness: "
      "2.0e-3}}\n";
  const std::string time = text.find("time:") == std::string::npos ? "time: {end: 1, step: 0.1}\n" : "";
  return scene::read_scene(types + text + time, "test.yaml");
}

inline network::Network network_of(const std::string& text) { return network::build_network(scene_of(text)); }

/// Per node: is it prescribed?
inline Table<SceneNode, bool> held_nodes(const network::Network& network) {
  Table<SceneNode, bool> held(network.position.size(), false);
  for (const auto& item : network.prescribed) held[item.node] = true;
  return held;
}

/// Noise in -1/2 .. 1/2, the same on every rank and machine.
inline double noise(int index) {
  const double value = std::sin(12.9898 * index + 0.37) * 43758.5453;
  return value - std::floor(value) - 0.5;
}

/// base + scale * noise.
inline Field disturbed(const Field& base, double scale, int seed) {
  Field field = base;
  for (SceneNode node(0); node.value() < field.size(); ++node)
    for (int k = 0; k < 3; ++k) field[node](k) += scale * noise(seed + 3 * node.value() + k);
  return field;
}

/// A network, cut for a communicator, and its assembler.
struct System {
  System(const network::Network& whole, system::ForceRule rule, MPI_Comm communicator)
      : network(whole),
        partition(partition::make_partition(whole, communicator)),
        assembler(partition::make_local_network(whole, partition, rank_of(communicator)), rule, communicator) {}

  /// The free nodes' part of a field, as a vector of the solver.
  system::Vector vector(const Field& field) const {
    system::Vector vector = assembler.make_vector();
    double* array = nullptr;
    petsc::check(VecGetArrayWrite(vector, &array));
    const partition::LocalNetwork& here = assembler.network();
    for (LocalNode node(0); here.is_owned(node); ++node)
      Eigen::Map<Vector3>(array + here.begin[node].value()) = field[here.scene_node[node]];
    petsc::check(VecRestoreArrayWrite(vector, &array));
    return vector;
  }

  /// The field of a vector of the solver, on every rank; zero at prescribed nodes.  Collective.
  Field field(Vec vector) const {
    Field field(network.position.size(), Vector3::Zero());
    const double* array = nullptr;
    petsc::check(VecGetArrayRead(vector, &array));
    const partition::LocalNetwork& here = assembler.network();
    for (LocalNode node(0); here.is_owned(node); ++node)
      field[here.scene_node[node]] = Eigen::Map<const Vector3>(array + here.begin[node].value());
    petsc::check(VecRestoreArrayRead(vector, &array));
    MPI_Allreduce(MPI_IN_PLACE, field.data(), static_cast<int>(3 * field.size()), MPI_DOUBLE, MPI_SUM,
                  assembler.communicator());
    return field;
  }

  network::Network network;
  partition::Partition partition;
  system::Assembler assembler;
};

/// The largest absolute component.
inline double size(const Field& field) {
  double largest = 0;
  for (const Vector3& value : field) largest = std::max(largest, value.cwiseAbs().maxCoeff());
  return largest;
}

inline Field difference(const Field& a, const Field& b) {
  Field field = a;
  for (SceneNode node(0); node.value() < a.size(); ++node) field[node] -= b[node];
  return field;
}

inline double sum_over_ranks(double value, MPI_Comm communicator = PETSC_COMM_WORLD) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, communicator);
  return value;
}

/// Sets a PETSc option as long as this object lives.
class Option {
public:
  Option(std::string name, const std::string& value) : name_(std::move(name)) {
    petsc::check(PetscOptionsSetValue(nullptr, name_.c_str(), value.c_str()));
  }
  ~Option() { PetscOptionsClearValue(nullptr, name_.c_str()); }
  Option(const Option&) = delete;
  Option& operator=(const Option&) = delete;

private:
  std::string name_;
};

}   // namespace cablenet::test
