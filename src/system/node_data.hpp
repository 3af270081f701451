#pragma once
#include <cstddef>

#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/partition/local_network.hpp"
#include "cablenet/system/ghosts.hpp"

namespace cablenet::system {

/// Where elements find their nodes' motion and leave their forces.
struct NodeData {
  int owned;
  const int* begin;   ///< per owned node: its first unknown in the solver's vectors
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
  static int name(const partition::LocalElement& e, std::size_t end) { return e.place[end]; }
  const double* x(int place) const { return data.x + place; }
  const double* v(int place) const { return data.v + place; }
  const double* a(int place) const { return data.a + place; }
  double* r(int place) const { return data.r + place; }
};

/// For any element.
struct AnyNodes {
  const NodeData& data;
  static int name(const partition::LocalElement& e, std::size_t end) { return e.node[end]; }
  bool is_owned(int node) const { return node < data.owned; }
  const NodeMotion& outside(int node) const { return data.outside[node - data.owned]; }
  const double* x(int node) const { return is_owned(node) ? data.x + data.begin[node] : outside(node).x; }
  const double* v(int node) const { return is_owned(node) ? data.v + data.begin[node] : outside(node).v; }
  const double* a(int node) const { return is_owned(node) ? data.a + data.begin[node] : outside(node).a; }
  double* r(int node) const {
    return is_owned(node) ? data.r + data.begin[node] : data.outside_r + 3 * std::ptrdiff_t{node - data.owned};
  }
};

}   // namespace cablenet::system
