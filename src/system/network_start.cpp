#include "network_start.hpp"

#include <algorithm>

#include "cablenet/bodies/rigid_body.hpp"
#include "cablenet/petsc/handle.hpp"

namespace cablenet::system {
namespace {

using petsc::check;

/// cos(pitch) one degree from the vertical: before a step leaves the domain of Euler angles.
constexpr double warning_cosine = 0.0175;

void fill(const partition::LocalNetwork& network, const Table<LocalNode, Vector3>& of_nodes,
          bodies::Vector4 bodies::RotationState::*of_bodies, Vec vector) {
  double* values = nullptr;
  check(VecGetArrayWrite(vector, &values));
  for (LocalNode node(0); network.is_owned(node); ++node)
    Eigen::Map<Vector3>(values + network.begin[node].value()) = of_nodes[node];
  for (int b = 0; b < network.own_bodies; ++b) {
    const partition::LocalBody& body = network.bodies[at(b)];
    const int unknowns = bodies::rotation_unknowns(body.properties.rotation);
    std::copy_n((body.start.*of_bodies).data(), unknowns, values + network.begin[body.node].value() + 3);
  }
  check(VecRestoreArrayWrite(vector, &values));
}

}   // namespace

void fill_start(const partition::LocalNetwork& network, Vec x, Vec v) {
  fill(network, network.position, &bodies::RotationState::y, x);
  fill(network, network.velocity, &bodies::RotationState::dy, v);
}

void set_start(const LocalState& state, const Vector3& velocity, partition::LocalNetwork& network) {
  for (LocalNode node(0); node.value() < network.nodes; ++node) {
    const bool is_moved_along = network.is_free(node) || network.is_carried(node);
    network.position[node] = state.position(node);
    network.velocity[node] = is_moved_along ? velocity : Vector3(state.velocity(node));
  }
  for (std::size_t b = 0; b < network.bodies.size(); ++b) {
    partition::LocalBody& body = network.bodies[b];
    body.start = bodies::rotation_state(body.properties.rotation, state.bodies[b].attitude, Vector3::Zero());
  }
}

int find_nearly_singular(const partition::LocalNetwork& network, Vec x, MPI_Comm communicator) {
  if (!network.has_euler_bodies) return -1;
  int found = -1;
  const double* values = nullptr;
  check(VecGetArrayRead(x, &values));
  for (int b = 0; b < network.own_bodies; ++b) {
    const partition::LocalBody& body = network.bodies[at(b)];
    bodies::Vector4 y = bodies::Vector4::Zero();
    const int unknowns = bodies::rotation_unknowns(body.properties.rotation);
    std::copy_n(values + network.begin[body.node].value() + 3, unknowns, y.data());
    if (bodies::distance_from_singular(body.properties.rotation, y) < warning_cosine) found = body.body;
  }
  check(VecRestoreArrayRead(x, &values));
  MPI_Allreduce(MPI_IN_PLACE, &found, 1, MPI_INT, MPI_MAX, communicator);
  return found;
}

}   // namespace cablenet::system
