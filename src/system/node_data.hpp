#pragma once
#include <cstddef>

#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/partition/local_network.hpp"
#include "cablenet/system/ghosts.hpp"

namespace cablenet::system {

/// Where elements find their nodes' motion and leave their forces.
struct NodeData {
  int owned;
  const Unknown* begin;   ///< per owned node: its first unknown in the solver's vectors
  const double* x;
  const double* v;
  const double* a;
  double* r;
  NodeMotion* outside;                      ///< motion of the other nodes
  double* outside_r;                        ///< their forces
  bodies::RotationState* ghost_rotations;   ///< of the ghosts that are bodies
};

inline Vector3 difference(const double* to, const double* from) {
  return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}

/// For elements between owned nodes.
struct InnerNodes {
  const NodeData& data;
  /// What the functions below know an element's node by.
  static Unknown name(const partition::LocalElement& e, std::size_t end) { return e.unknown[end]; }
  const double* x(Unknown unknown) const { return data.x + unknown.value(); }
  const double* v(Unknown unknown) const { return data.v + unknown.value(); }
  const double* a(Unknown unknown) const { return data.a + unknown.value(); }
  double* r(Unknown unknown) const { return data.r + unknown.value(); }
};

/// For any element.
struct AnyNodes {
  const NodeData& data;
  static LocalNode name(const partition::LocalElement& e, std::size_t end) { return e.node[end]; }
  bool is_owned(LocalNode node) const { return node.value() < data.owned; }
  const NodeMotion& outside(LocalNode node) const { return data.outside[node.value() - data.owned]; }
  const double* x(LocalNode node) const {
    return is_owned(node) ? data.x + data.begin[node.value()].value() : outside(node).x;
  }
  const double* v(LocalNode node) const {
    return is_owned(node) ? data.v + data.begin[node.value()].value() : outside(node).v;
  }
  const double* a(LocalNode node) const {
    return is_owned(node) ? data.a + data.begin[node.value()].value() : outside(node).a;
  }
  double* r(LocalNode node) const {
    return is_owned(node) ? data.r + data.begin[node.value()].value()
                          : data.outside_r + 3 * std::ptrdiff_t{node.value() - data.owned};
  }
};

}   // namespace cablenet::system
