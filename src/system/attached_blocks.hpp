#pragma once
#include <type_traits>

#include "body_set.hpp"
#include "cablenet/elements/cable_in_water.hpp"
#include "element_loop.hpp"

/// What elements and links at bodies write into the tangent.
namespace cablenet::system {

/// Derivatives of an element's forces by its ends' motion: +k on an end's own, -k on the other's.
struct AttachedTangent {
  Matrix3 k_x, k_v;      ///< [N/m], [N s/m]
  double mass;           ///< of the consistent matrix mass [[2, 1], [1, 2]] [kg]
  double mass_damping;   ///< [1/s]
  bool is_damped;        ///< k_v or mass_damping is not zero
};

/// Writes an attached element's four blocks, each L_i^T (k_x dx_j + k_v dv_j + m da_j), where an end's motion by its
/// unknowns is [1, a carried node's by the attitude], and L_i^T likewise takes forces to them.
class AttachedBlocks {
public:
  AttachedBlocks(const partition::LocalNetwork& network, BodySet& bodies, const TangentTarget& target)
      : network_(network), bodies_(bodies), target_(target) {}

  void write(const std::array<LocalNode, 2>& node, const TangentMatrix::ElementSlots& slots,
             const AttachedTangent& t) const {
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j) write_block(node[i], node[j], i == j, slots[2 * i + j], t);
  }

  /// Adds to a block that is written.  @param slot  of the two nodes, absent for one that is carried
  void add(LocalNode row, LocalNode column, TangentMatrix::Slot slot, const MotionSlopes& slopes,
           const Shift& follow) const {
    BodyBlock* const own = shared_block(row, column);
    if (slot.absent && own == nullptr) return;
    slot.add = 1;
    RowMajor<3, 8> part = RowMajor<3, 8>::Zero();
    part.leftCols<3>() = follow.x * slopes.by_x + follow.v * slopes.by_v + follow.a * slopes.by_a;
    const CarriedTangent* const turning = carried(column);
    if (turning) part.middleCols<4>(3) = slopes.by_x * turning->x + slopes.by_v * turning->v + slopes.by_a * turning->a;
    put(own, slot, carried(row), part, turning != nullptr ? 3 + turning->unknowns : 3);
  }

private:
  /// nullptr for nodes that no body carries.
  const CarriedTangent* carried(LocalNode node) const {
    return network_.is_carried(node) ? &bodies_.carried_tangent(node) : nullptr;
  }
  BodyBlock* shared_block(LocalNode one, LocalNode other) const {
    if (!network_.is_carried(one) || !network_.is_carried(other)) return nullptr;
    return network_.carried_at(one).body == network_.carried_at(other).body ? bodies_.block_at(one) : nullptr;
  }

  void write_block(LocalNode row, LocalNode column, bool diagonal, const TangentMatrix::Slot& slot,
                   const AttachedTangent& t) const {
    BodyBlock* const own = shared_block(row, column);
    if (slot.absent && own == nullptr) return;
    const double sign = diagonal ? 1 : -1, m = (diagonal ? 2 : 1) * t.mass;
    Matrix3 by_position = sign * (t.k_x + target_.shift_v * t.k_v);
    by_position.diagonal().array() += m * (target_.shift_a + t.mass_damping * target_.shift_v);
    const CarriedTangent* const turning = carried(column);
    if (turning == nullptr) {
      RowMajor<3, 4> part = RowMajor<3, 4>::Zero();
      part.leftCols<3>() = by_position;
      return put(own, slot, carried(row), part, 3);
    }
    RowMajor<3, 8> part = RowMajor<3, 8>::Zero();
    part.leftCols<3>() = by_position;
    const Matrix3 K = sign * t.k_x;
    for (int i = 0; i < 3; ++i) part.row(i).segment<4>(3) = m * turning->a.row(i) + combined(K.row(i), turning->x);
    if (t.is_damped) part.middleCols<4>(3) += (sign * t.k_v + m * t.mass_damping * Matrix3::Identity()) * turning->v;
    put(own, slot, carried(row), part, 3 + turning->unknowns);
  }

  /// The sum of three rows, times these weights: whole rows at a time.
  template <class Weights, int width>
  static RowMajor<1, width> combined(const Weights& w, const RowMajor<3, width>& rows) {
    return w(0) * rows.row(0) + w(1) * rows.row(1) + w(2) * rows.row(2);
  }

  /// Rows of the position, and those of the attitude where there is one.
  template <int width>
  void put(BodyBlock* own, const TangentMatrix::Slot& slot, const CarriedTangent* rows, const RowMajor<3, width>& part,
           int columns) const {
    RowMajor<4, width> turned;
    for (int i = 0; rows != nullptr && i < 4; ++i) turned.row(i) = combined(rows->load.col(i), part);
    if (own != nullptr) {
      own->topLeftCorner<3, width>() += part;
      own->bottomLeftCorner<4, width>() += turned;
      return;
    }
    double* to = target_.values[slot.other] + slot.offset;
    const auto put_rows = [&](auto count) {
      for (int r = 0; r < 3; ++r, to += slot.stride) put_row(to, slot, part.data() + width * r, count);
      if (rows == nullptr) return;
      for (int r = 0; r < rows->unknowns; ++r, to += slot.stride) put_row(to, slot, turned.data() + width * r, count);
    };
    // Loops of known length are several times faster; only Euler angles have another one.
    constexpr int usual = width - 1;
    if (columns == usual)
      put_rows(std::integral_constant<int, usual>());
    else
      put_rows(columns);
  }

  template <class Count>
  static void put_row(double* to, const TangentMatrix::Slot& slot, const double* from, Count count) {
    if (slot.add)
      for (int c = 0; c < count; ++c) to[c] += from[c];
    else
      for (int c = 0; c < count; ++c) to[c] = from[c];
  }

  const partition::LocalNetwork& network_;
  BodySet& bodies_;
  const TangentTarget& target_;
};

}   // namespace cablenet::system
