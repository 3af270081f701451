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
  const double* a;                          ///< null where no accelerations are given
  double* r;                                ///< null where no residual is asked for
  NodeMotion* outside;                      ///< motion of the nodes that are not owned
  double* outside_r;                        ///< their forces
  bodies::RotationState* ghost_rotations;   ///< of the ghosts that are bodies
};

inline Vector3 difference(const double* to, const double* from) {
  return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}

/// The nodes of elements between owned nodes, known by their first unknowns.
struct InnerNodes {
  static constexpr bool may_be_absent = false;
  const NodeData& data;

  static Unknown key(const partition::LocalElement& e, std::size_t end) { return e.unknown[end]; }
  const double* x(Unknown node) const { return data.x + node.value(); }
  const double* v(Unknown node) const { return data.v + node.value(); }
  const double* a(Unknown node) const { return data.a + node.value(); }
  double* r(Unknown node) const { return data.r + node.value(); }
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
  const double* x(LocalNode node) const { return is_owned(node) ? data.x + unknown(node) : outside(node).x; }
  const double* v(LocalNode node) const { return is_owned(node) ? data.v + unknown(node) : outside(node).v; }
  const double* a(LocalNode node) const { return is_owned(node) ? data.a + unknown(node) : outside(node).a; }
  double* r(LocalNode node) const { return is_owned(node) ? data.r + unknown(node) : outside_r(node); }
  double* outside_r(LocalNode node) const { return data.outside_r + 3 * std::ptrdiff_t{node.value() - data.owned}; }
};

/// Nodes of an observed state.
struct StateNodes {
  const LocalState& state;

  static LocalNode key(const partition::LocalElement& e, std::size_t end) { return e.node[end]; }
  const double* x(LocalNode node) const { return state.x.data() + 3 * at(node); }
  const double* v(LocalNode node) const { return state.v.data() + 3 * at(node); }
  const double* a(LocalNode node) const { return state.a.data() + 3 * at(node); }
};

}   // namespace cablenet::system
