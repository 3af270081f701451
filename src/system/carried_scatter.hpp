#pragma once
#include <type_traits>

#include "carried_slopes.hpp"

/// How a kernel's forces and slopes reach nodes that bodies carry.  L_j says how node j moves with its body's unknowns.
/// A block of the tangent is then L_i^T (x dx_j + v dv_j + a da_j), with the kernel's slopes x, v and a apart.
namespace cablenet::system {

/// Adds forces and blocks at carried nodes and at their neighbours.
class CarriedScatter {
public:
  explicit CarriedScatter(const Evaluation& evaluation)
      : nodes{evaluation.data},
        carried_(evaluation.carried),
        target_(evaluation.target),
        has_residual_(evaluation.has_residual) {}

  const AnyNodes nodes;

  /// A body's tangent needs the forces on the nodes that it carries, even where no residual is asked for.
  void add_force(LocalNode node, const Vector3& force) const {
    if (has_residual_ || carried_.network.is_carried(node)) nodes.r(node) += force;
  }

  template <bool owns_slots, class Apart>
  void add_pair(const std::array<LocalNode, 2>& node, const PairSlots& slots, const Apart& by,
                const Shift& shift) const {
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j)
        add_block<owns_slots>(node[i], node[j], slots[2 * i + j], by.x(i, j), by.v(i, j), by.a(i, j), shift);
  }

  template <bool owns_slot, class X, class V, class A>
  void add_block(LocalNode row, LocalNode column, Slot slot, const X& x, const V& v, const A& a,
                 const Shift& shift) const {
    bodies::BodyBlock* const own = carried_.shared_block(row, column);
    if (slot.absent && own == nullptr) return;
    slot.add = !owns_slot || slot.add;
    Matrix3 by_position = Matrix3::Zero();
    add_scaled(by_position, shift.x, x);
    add_scaled(by_position, shift.v, v);
    add_scaled(by_position, shift.a, a);
    const bodies::CarriedTangent* const turning = carried_.tangent(column);
    if (turning == nullptr) {
      bodies::RowMajor<3, 4> part = bodies::RowMajor<3, 4>::Zero();
      part.leftCols<3>() = by_position;
      return put(own, slot, carried_.tangent(row), part, 3);
    }
    bodies::RowMajor<3, 4> by_attitude = bodies::RowMajor<3, 4>::Zero();
    add_product(by_attitude, x, turning->x);
    add_product(by_attitude, v, turning->v);
    add_product(by_attitude, a, turning->a);
    bodies::RowMajor<3, 8> part = bodies::RowMajor<3, 8>::Zero();
    part.leftCols<3>() = by_position;
    part.middleCols<4>(3) = by_attitude;
    put(own, slot, carried_.tangent(row), part, 3 + turning->unknowns);
  }

private:
  /// Rows of the position, and those of the attitude where there is one.
  template <int width>
  void put(bodies::BodyBlock* own, const Slot& slot, const bodies::CarriedTangent* rows,
           const bodies::RowMajor<3, width>& part, int columns) const {
    bodies::RowMajor<4, width> turned;
    for (int i = 0; rows != nullptr && i < 4; ++i) {
      const auto w = rows->load.col(i);
      turned.row(i) = w(0) * part.row(0) + w(1) * part.row(1) + w(2) * part.row(2);
    }
    if (own != nullptr) {
      own->topLeftCorner<3, width>() += part;
      own->bottomLeftCorner<4, width>() += turned;
      return;
    }
    double* to = target_.values[slot.other] + slot.offset;
    const auto put_rows = [&](auto count) {
      for (int r = 0; r < 3; ++r, to += slot.stride) put_values(to, slot, part.data() + width * r, count);
      if (rows == nullptr) return;
      for (int r = 0; r < rows->unknowns; ++r, to += slot.stride)
        put_values(to, slot, turned.data() + width * r, count);
    };
    // Loops of known length are several times faster; only Euler angles have another one.
    constexpr int usual = width - 1;
    if (columns == usual)
      put_rows(std::integral_constant<int, usual>());
    else
      put_rows(columns);
  }

  template <class Count>
  static void put_values(double* to, const Slot& slot, const double* from, Count count) {
    if (slot.add)
      for (int c = 0; c < count; ++c) to[c] += from[c];
    else
      for (int c = 0; c < count; ++c) to[c] = from[c];
  }

  CarriedNodes& carried_;
  const TangentTarget& target_;
  bool has_residual_;
};

}   // namespace cablenet::system
