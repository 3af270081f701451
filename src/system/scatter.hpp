#pragma once
#include "evaluation.hpp"

/// How a kernel's forces and slopes reach nodes with unknowns of their own.  A kernel of two nodes answers with a
/// response: `on`, the residuals on its nodes [N], and slope<i, j>(), the derivative of the residual on node i by the
/// unknowns of node j [N/m].
namespace cablenet::system {

/// sign K + m I, whose values are made where they are written.
struct ChordSlope {
  const Matrix3& K;
  double sign, m;

  double operator()(int i, int j) const { return i == j ? sign * K(i, j) + m : sign * K(i, j); }
};

/// Of two nodes.  The forces depend on the chord alone, apart from a consistent mass: slopes are +K, -K and
/// m [[2, 1], [1, 2]].
struct ChordResponse {
  std::array<Vector3, 2> on;
  Matrix3 K;
  double m;

  template <int i, int j>
  ChordSlope slope() const {
    return {K, i == j ? 1.0 : -1.0, (i == j ? 2 : 1) * m};
  }
};

/// Of two nodes, without structure.
struct PairResponse {
  std::array<Vector3, 2> on;
  std::array<std::array<Matrix3, 2>, 2> by;

  template <int i, int j>
  const Matrix3& slope() const {
    return by[i][j];
  }
};

/// Of one node, with its slopes by the node's position [N/m], velocity [N s/m] and acceleration [kg] apart.
struct NodeResponse {
  Vector3 on;
  Matrix3 x, v, a;

  Matrix3 slope(const Shift& shift) const { return shift.x * x + shift.v * v + shift.a * a; }
};

inline void put_row(double* to, bool add, double x, double y, double z) {
  to[0] = add ? to[0] + x : x;
  to[1] = add ? to[1] + y : y;
  to[2] = add ? to[2] + z : z;
}

/// Writes or adds a block.  @param owns_slot  the slot is the kernel's own, so that it says which of the two
template <class Nodes, bool owns_slot, class Block>
void put_block(const TangentTarget& target, const Slot& slot, const Block& K) {
  if (Nodes::may_be_absent && slot.absent) return;
  double* to = (Nodes::may_be_absent && slot.other ? target.values[1] : target.values[0]) + slot.offset;
  const std::ptrdiff_t stride = slot.stride;
  put_row(to, !owns_slot || slot.add, K(0, 0), K(0, 1), K(0, 2));
  put_row(to + stride, !owns_slot || slot.add, K(1, 0), K(1, 1), K(1, 2));
  put_row(to + 2 * stride, !owns_slot || slot.add, K(2, 0), K(2, 1), K(2, 2));
}

template <class Nodes, bool owns_slot, class Response>
void put_blocks(const TangentTarget& target, const PairSlots& slots, const Response& response) {
  put_block<Nodes, owns_slot>(target, slots[0], response.template slope<0, 0>());
  put_block<Nodes, owns_slot>(target, slots[1], response.template slope<0, 1>());
  put_block<Nodes, owns_slot>(target, slots[2], response.template slope<1, 0>());
  put_block<Nodes, owns_slot>(target, slots[3], response.template slope<1, 1>());
}

/// What a kernel does to nodes with unknowns of their own.  BodyScatter does the same at those that bodies carry.
template <bool with_residual, bool with_tangent, class Nodes, class Kernel>
struct Scatter {
  const Kernel& kernel;
  Nodes nodes;
  const TangentTarget& target;
  const Shift shift;

  /// A kernel of two nodes.  @returns false where it is not defined
  template <class Item>
  [[gnu::flatten]] bool pair(std::size_t i, const Item& item, const PairSlots& slots) const {
    typename Kernel::Response response;
    if (!kernel.template evaluate<with_residual, with_tangent>(i, item, nodes, shift, response)) return false;
    if constexpr (with_residual)
      for (std::size_t k = 0; k < 2; ++k) nodes.r(nodes.key(item, k)) += response.on[k];
    if constexpr (with_tangent) put_blocks<Nodes, Kernel::owns_slots>(target, slots, response);
    return true;
  }

  /// A kernel of one node, which answers false where nothing acts.
  template <class Key>
  [[gnu::flatten]] void node(std::size_t i, Key key, const Slot& slot) const {
    NodeResponse response;
    if (!kernel.template evaluate<with_tangent>(i, key, nodes, response)) return;
    if constexpr (with_residual) nodes.r(key) += response.on;
    if constexpr (with_tangent) put_block<Nodes, Kernel::owns_slots>(target, slot, response.slope(shift));
  }
};

}   // namespace cablenet::system
