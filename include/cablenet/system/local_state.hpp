#pragma once
#include <vector>

#include "cablenet/elements/cable_data.hpp"
#include "cablenet/partition/local_network.hpp"
#include "cablenet/system/energies.hpp"

namespace cablenet::system {

struct BodyState {
  Quaternion attitude;   ///< body axes to world, unit, of continuous sign
  Vector3 w;             ///< angular velocity, body axes [rad/s]
};

/// Positions, velocities and accelerations of all local nodes at an instant: three doubles a node, in local order.
struct LocalState {
  using Node = Eigen::Map<const Vector3>;

  double t = 0;
  bool is_calm = false;            ///< The water has no waves, as in statics.
  std::vector<BodyState> bodies;   ///< as LocalNetwork::bodies
  std::vector<double> x;           ///< [m]
  std::vector<double> v;           ///< [m/s]
  std::vector<double> a;           ///< [m/s^2]

  Node position(LocalNode node) const { return Node(x.data() + 3 * at(node)); }
  Node velocity(LocalNode node) const { return Node(v.data() + 3 * at(node)); }
  Node acceleration(LocalNode node) const { return Node(a.data() + 3 * at(node)); }
  elements::Chord chord(const partition::LocalElement& e) const {
    return {position(e.node[1]) - position(e.node[0]), velocity(e.node[1]) - velocity(e.node[0])};
  }
  /// a + beta v at an element's two nodes [m/s^2].
  elements::EndAccelerations inertial(const partition::LocalElement& e, double beta) const {
    return {acceleration(e.node[0]) + beta * velocity(e.node[0]), acceleration(e.node[1]) + beta * velocity(e.node[1])};
  }
};

}   // namespace cablenet::system
