#pragma once
#include <cstddef>
#include <vector>

#include "cablenet/elements/cable_data.hpp"
#include "cablenet/partition/local_network.hpp"

namespace cablenet::system {

/// Energies and work, [J].  total() is constant where nothing dissipates.
struct Energies {
  double kinetic = 0;
  double strain = 0;
  double gravity = 0;   ///< m g z
  double work = 0;      ///< by moved points and constant forces since the start
  double total() const { return kinetic + strain + gravity - work; }
};

struct BodyState {
  Quaternion attitude;   ///< body axes to world, unit, of continuous sign
  Vector3 w;             ///< angular velocity, body axes [rad/s]
};

/// Positions, velocities, accelerations of this rank's local nodes: 3 doubles a node, in local order.
struct LocalState {
  double t = 0;
  std::vector<BodyState> bodies;   ///< as LocalNetwork::bodies
  std::vector<double> x;           ///< [m]
  std::vector<double> v;           ///< [m/s]
  std::vector<double> a;           ///< [m/s^2]

  static Eigen::Map<const Vector3> at(const std::vector<double>& values, LocalNode node) {
    return Eigen::Map<const Vector3>(values.data() + 3 * cablenet::at(node));
  }
  static Eigen::Map<Vector3> at(std::vector<double>& values, LocalNode node) {
    return Eigen::Map<Vector3>(values.data() + 3 * cablenet::at(node));
  }
  elements::Chord chord(const partition::LocalElement& e) const {
    return {at(x, e.node[1]) - at(x, e.node[0]), at(v, e.node[1]) - at(v, e.node[0])};
  }
  /// a + beta v at an element's two nodes.
  elements::EndAccelerations inertial(const partition::LocalElement& e, double beta) const {
    return {at(a, e.node[0]) + beta * at(v, e.node[0]), at(a, e.node[1]) + beta * at(v, e.node[1])};
  }
};

}   // namespace cablenet::system
