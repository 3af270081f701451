#pragma once
#include "attached_blocks.hpp"

/// What an element that ends on a body, or a link to one, does in the loop over elements.
namespace cablenet::system {

/// Forces go to carried nodes always, as their bodies' tangent needs them; to others where there is a residual.
inline void add_attached_force(const partition::LocalNetwork& network, const AnyNodes& nodes, LocalNode node,
                               const Vector3& force) {
  if (nodes.data.r == nullptr && !network.is_carried(node)) return;
  Eigen::Map<Vector3>(nodes.r(node)) += force;
}

template <class Law, bool with_tangent>
struct AttachedWork {
  const partition::LocalNetwork& network;
  const Law& law;
  const typename Law::Start* starts;
  AnyNodes nodes;
  const TangentTarget& target;
  AttachedBlocks blocks;

  [[gnu::flatten]] bool operator()(std::size_t i, const partition::LocalElement& e) const {
    const elements::CableMaterial& material = network.materials[static_cast<std::size_t>(e.material)];
    const auto [n1, n2] = e.node;
    ElementStage stage{material, e.length, difference(nodes.x(n2), nodes.x(n1)), Vector3::Zero(), 0};
    if constexpr (Law::general) stage.w = difference(nodes.v(n2), nodes.v(n1));
    Vector3 f;
    Matrix3 K;
    if (!law.template evaluate<with_tangent>(starts[i], stage, f, K)) return false;
    const Vector3 q1 = inertial<Law>(network, nodes, material, n1), q2 = inertial<Law>(network, nodes, material, n2);
    const elements::EndForces inertia = elements::cable_inertia(material, e.length, q1, q2);
    add_attached_force(network, nodes, n1, inertia.on1 - f);
    add_attached_force(network, nodes, n2, inertia.on2 + f);
    if constexpr (with_tangent) {
      AttachedTangent tangent{K, Matrix3::Zero(), material.mass_per_length * e.length / 6, material.mass_damping,
                              Law::general};
      if constexpr (Law::general) {
        stage.shift_v = 1;
        law.template evaluate<true>(starts[i], stage, f, K);
        tangent.k_v = K - tangent.k_x;
      }
      blocks.write(e.node, target.slots[i], tangent);
    }
    return true;
  }
};

/// Forces stiffness * gap at the stage, which all schemes share: it is linear in positions.
inline void add_links(const partition::LocalNetwork& network, const AnyNodes& nodes, const TangentRequest* request,
                      const AttachedBlocks& blocks) {
  for (std::size_t i = 0; i < network.links.size(); ++i) {
    const auto& [node, stiffness] = network.links[i];
    const Vector3 force = stiffness * difference(nodes.x(node[1]), nodes.x(node[0]));
    add_attached_force(network, nodes, node[0], -force);
    add_attached_force(network, nodes, node[1], force);
    if (request == nullptr) continue;
    const Matrix3 slope = request->shift_x * stiffness * Matrix3::Identity();
    blocks.write(node, request->matrix.link_slots()[i], {slope, Matrix3::Zero(), 0, 0, false});
  }
}

}   // namespace cablenet::system
