#pragma once
#include <cstddef>

#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/partition/local_network.hpp"
#include "cablenet/system/ghosts.hpp"
#include "cablenet/system/local_state.hpp"

/// Where terms find their nodes' motion and leave their forces.
namespace cablenet::system {

struct NodeData {
  int owned;
  const Unknown* begin;   ///< per owned node: its first unknown in the solver's vectors
  const double* x;
  const double* v;
  const double* a = nullptr;                          ///< null where no accelerations are given
  double* r = nullptr;                                ///< null where no residual is asked for
  NodeMotion* outside = nullptr;                      ///< motion of the nodes that are not owned
  double* outside_r = nullptr;                        ///< their forces
  bodies::RotationState* ghost_rotations = nullptr;   ///< of the ghosts that are bodies
};

using ConstVector = Eigen::Map<const Vector3>;

/// The nodes of elements between owned nodes, known by their first unknowns.
struct InnerNodes {
  static constexpr bool may_be_absent = false;
  const NodeData& data;

  static Unknown key(const partition::LocalElement& e, std::size_t end) { return e.unknown[end]; }
  ConstVector x(Unknown node) const { return ConstVector(data.x + node.value()); }
  ConstVector v(Unknown node) const { return ConstVector(data.v + node.value()); }
  ConstVector a(Unknown node) const { return ConstVector(data.a + node.value()); }
  Eigen::Map<Vector3> r(Unknown node) const { return Eigen::Map<Vector3>(data.r + node.value()); }
};

/// Any nodes.
struct AnyNodes {
  static constexpr bool may_be_absent = true;
  const NodeData& data;

  template <class Item>
  static LocalNode key(const Item& item, std::size_t end) {
    return item.node[end];
  }
  bool is_owned(LocalNode node) const { return node.value() < data.owned; }
  int unknown(LocalNode node) const { return data.begin[node.value()].value(); }
  NodeMotion& outside(LocalNode node) const { return data.outside[node.value() - data.owned]; }
  ConstVector x(LocalNode node) const { return part(node, data.x, &NodeMotion::x); }
  ConstVector v(LocalNode node) const { return part(node, data.v, &NodeMotion::v); }
  ConstVector a(LocalNode node) const { return part(node, data.a, &NodeMotion::a); }
  Eigen::Map<Vector3> r(LocalNode node) const {
    return Eigen::Map<Vector3>(is_owned(node) ? data.r + unknown(node) : outside_r(node));
  }
  double* outside_r(LocalNode node) const { return data.outside_r + 3 * std::ptrdiff_t{node.value() - data.owned}; }
  ConstVector part(LocalNode node, const double* owned, Vector3 NodeMotion::*other) const {
    return ConstVector(is_owned(node) ? owned + unknown(node) : (outside(node).*other).data());
  }
};

/// Nodes of an observed state.
struct StateNodes {
  const LocalState& state;

  static LocalNode key(const partition::LocalElement& e, std::size_t end) { return e.node[end]; }
  ConstVector x(LocalNode node) const { return state.position(node); }
  ConstVector v(LocalNode node) const { return state.velocity(node); }
  ConstVector a(LocalNode node) const { return state.acceleration(node); }
};

}   // namespace cablenet::system
