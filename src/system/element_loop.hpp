#pragma once
#include <type_traits>

#include "cablenet/elements/cable_step.hpp"
#include "cablenet/partition/local_network.hpp"
#include "cablenet/system/tangent_matrix.hpp"
#include "force_laws.hpp"
#include "node_data.hpp"

/// The loop over elements, and what an element does in it.
namespace cablenet::system {

using partition::Range;

/// The program's one loop over elements.
/// @param visit  bool(element index, element); false ends the loop
template <class Visit>
bool for_each_element(const partition::LocalNetwork& network, Range range, Visit&& visit) {
  for (std::size_t i = static_cast<std::size_t>(range.first); i < static_cast<std::size_t>(range.last); ++i)
    if (!visit(i, network.elements[i])) return false;
  return true;
}

struct TangentTarget {
  std::array<double*, 2> values;
  const TangentMatrix::ElementSlots* slots;
  double shift_v, shift_a;
};

inline void put_row(double* to, bool add, double x, double y, double z) {
  to[0] = add ? to[0] + x : x;
  to[1] = add ? to[1] + y : y;
  to[2] = add ? to[2] + z : z;
}

/// Writes or adds sign K + m I.
template <class Nodes>
void put_block(const TangentTarget& target, const TangentMatrix::Slot& slot, double sign, const Matrix3& K, double m) {
  constexpr bool any = std::is_same_v<Nodes, AnyNodes>;
  if (any && slot.absent) return;
  double* to = (any && slot.other ? target.values[1] : target.values[0]) + slot.offset;
  put_row(to, slot.add, sign * K(0, 0) + m, sign * K(0, 1), sign * K(0, 2));
  put_row(to + slot.stride, slot.add, sign * K(1, 0), sign * K(1, 1) + m, sign * K(1, 2));
  put_row(to + 2 * slot.stride, slot.add, sign * K(2, 0), sign * K(2, 1), sign * K(2, 2) + m);
}

/// a + beta v of a node; weight joins in as an acceleration.
template <class Law, class Nodes, class Name>
Vector3 inertial(const partition::LocalNetwork& network, const Nodes& nodes, const elements::CableMaterial& material,
                 Name node) {
  Vector3 q = Eigen::Map<const Vector3>(nodes.a(node));
  if constexpr (Law::general) q += material.mass_damping * Eigen::Map<const Vector3>(nodes.v(node));
  q.z() += network.gravity;
  return q;
}

/// M (a + beta v) + (-f, +f) - weight/2 each, and its tangent.
template <class Law, class Nodes, bool with_residual, bool with_tangent>
struct ElementWork {
  const partition::LocalNetwork& network;
  const Law& law;
  const typename Law::Start* starts;
  Nodes nodes;
  TangentTarget target;

  [[gnu::flatten]] bool operator()(std::size_t i, const partition::LocalElement& e) const {
    const elements::CableMaterial& material = network.materials[static_cast<std::size_t>(e.material)];
    const auto n1 = Nodes::name(e, 0), n2 = Nodes::name(e, 1);
    ElementStage stage{material, e.length, difference(nodes.x(n2), nodes.x(n1)), Vector3::Zero(), target.shift_v};
    if constexpr (Law::general) stage.w = difference(nodes.v(n2), nodes.v(n1));
    Vector3 f;
    Matrix3 K;
    if (!law.template evaluate<with_tangent>(starts[i], stage, f, K)) return false;
    if constexpr (with_residual) {
      const Vector3 q1 = inertial<Law>(network, nodes, material, n1);
      const Vector3 q2 = inertial<Law>(network, nodes, material, n2);
      const elements::EndForces inertia = elements::cable_inertia(material, e.length, q1, q2);
      Eigen::Map<Vector3>(nodes.r(n1)) += inertia.on1 - f;
      Eigen::Map<Vector3>(nodes.r(n2)) += inertia.on2 + f;
    }
    if constexpr (with_tangent) {
      double m = material.mass_per_length * e.length / 6 * target.shift_a;
      if constexpr (Law::general) m += material.mass_per_length * e.length / 6 * material.mass_damping * target.shift_v;
      const TangentMatrix::ElementSlots& slots = target.slots[i];
      put_block<Nodes>(target, slots[0], 1, K, 2 * m);
      put_block<Nodes>(target, slots[1], -1, K, m);
      put_block<Nodes>(target, slots[2], -1, K, m);
      put_block<Nodes>(target, slots[3], 1, K, 2 * m);
    }
    return true;
  }
};

}   // namespace cablenet::system
