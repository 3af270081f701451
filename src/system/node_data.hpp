#pragma once
#include <cstddef>

#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/system/ghosts.hpp"

namespace cablenet::system {

/// Where elements find their nodes' motion and leave their forces.  Owned nodes have 3 values each in solver vectors.
struct NodeData {
  int owned;
  const double* x;
  const double* v;
  const double* a;
  double* r;
  NodeMotion* outside;   ///< motion of the other nodes
  double* outside_r;     ///< their forces
};

inline Vector3 difference(const double* to, const double* from) {
  return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}

/// For elements between owned nodes.
struct InnerNodes {
  const NodeData& data;
  const double* x(int node) const { return data.x + 3 * std::ptrdiff_t{node}; }
  const double* v(int node) const { return data.v + 3 * std::ptrdiff_t{node}; }
  const double* a(int node) const { return data.a + 3 * std::ptrdiff_t{node}; }
  double* r(int node) const { return data.r + 3 * std::ptrdiff_t{node}; }
};

/// For any element.
struct AnyNodes {
  const NodeData& data;
  bool is_owned(int node) const { return node < data.owned; }
  const NodeMotion& outside(int node) const { return data.outside[node - data.owned]; }
  const double* x(int node) const { return is_owned(node) ? InnerNodes{data}.x(node) : outside(node).x; }
  const double* v(int node) const { return is_owned(node) ? InnerNodes{data}.v(node) : outside(node).v; }
  const double* a(int node) const { return is_owned(node) ? InnerNodes{data}.a(node) : outside(node).a; }
  double* r(int node) const {
    return is_owned(node) ? InnerNodes{data}.r(node) : data.outside_r + 3 * std::ptrdiff_t{node - data.owned};
  }
};

}   // namespace cablenet::system
