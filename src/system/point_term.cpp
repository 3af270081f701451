#include "point_term.hpp"

#include "item_loops.hpp"

namespace cablenet::system {
namespace {

struct PointKernel {
  static constexpr bool owns_slots = true;
  const partition::LocalNetwork& network;

  template <bool with_tangent, class Nodes, class Key>
  bool evaluate(std::size_t i, Key node, const Nodes& nodes, NodeResponse& out) const {
    const auto& load = network.loads[i];
    out.on = load.mass * (nodes.a(node) + Vector3(0, 0, network.gravity)) - load.force;
    if constexpr (with_tangent) {
      out.x.setZero();
      out.v.setZero();
      out.a = load.mass * Matrix3::Identity();
    }
    return true;
  }
};

}   // namespace

void PointTerm::add(Evaluation& evaluation) {
  if (!slots_.empty()) add_to_nodes(evaluation, PointKernel{network_}, network_.loads, slots_);
}

void PointTerm::add_energy(const LocalState& state, Energies& sum) const {
  for (const auto& [node, mass, force] : network_.loads) {
    const auto x = state.position(node);
    sum.kinetic += 0.5 * mass * state.velocity(node).squaredNorm();
    sum.gravity += mass * network_.gravity * x.z();
    sum.work += force.dot(x - network_.position[node]);
  }
}

void PointTerm::add_scales(const LocalState&, ForceSums& sums) const {
  for (const auto& load : network_.loads) {
    sums.load += square(load.mass * network_.gravity) + load.force.squaredNorm();
    sums.mass += square(load.mass);
  }
}

Vector3 PointTerm::node_force(const LocalState& state, LocalNode node) const {
  NodeResponse response;
  response.on.setZero();
  for (std::size_t i = 0; i < network_.loads.size(); ++i)
    if (network_.loads[i].node == node) PointKernel{network_}.evaluate<false>(i, node, StateNodes{state}, response);
  return response.on;
}

}   // namespace cablenet::system
