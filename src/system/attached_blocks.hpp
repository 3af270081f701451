#pragma once
#include "body_set.hpp"
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

  void write(const std::array<int, 2>& node, const TangentMatrix::ElementSlots& slots, const AttachedTangent& t) const {
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j) write_block(node[i], node[j], i == j, slots[2 * i + j], t);
  }

private:
  /// A carried node's part of the tangent; nullptr for other nodes.
  const CarriedTangent* carried(int node) const {
    return network_.is_carried(node) ? &bodies_.carried_tangent(node) : nullptr;
  }
  BodyBlock* shared_block(int one, int other) const {
    if (!network_.is_carried(one) || !network_.is_carried(other)) return nullptr;
    return network_.carried_at(one).body == network_.carried_at(other).body ? bodies_.block_at(one) : nullptr;
  }

  void write_block(int row, int column, bool diagonal, const TangentMatrix::Slot& slot,
                   const AttachedTangent& t) const {
    BodyBlock* const own = shared_block(row, column);
    if (slot.absent && own == nullptr) return;
    const double sign = diagonal ? 1 : -1, m = (diagonal ? 2 : 1) * t.mass;
    const CarriedTangent *const rows = carried(row), *const columns = carried(column);
    Matrix3 by_position = sign * (t.k_x + target_.shift_v * t.k_v);
    by_position.diagonal().array() += m * (target_.shift_a + t.mass_damping * target_.shift_v);
    const auto put = [&](int first, int width, const auto& part) {
      add(own, slot, {0, first, 3, width}, part);
      if (rows != nullptr) add(own, slot, {3, first, rows->unknowns, width}, (rows->load.transpose() * part).eval());
    };
    put(0, 3, by_position);
    if (columns == nullptr) return;
    bodies::Matrix34 by_attitude = m * columns->a + sign * (t.k_x * columns->x);
    if (t.is_damped) by_attitude += (sign * t.k_v + m * t.mass_damping * Matrix3::Identity()) * columns->v;
    put(3, columns->unknowns, by_attitude);
  }

  struct Place {
    int row, column, rows, columns;
  };

  template <class Part>
  [[gnu::always_inline]] static void put(double* to, const TangentMatrix::Slot& slot, const Part& part, int rows,
                                         int columns) {
    for (int r = 0; r < rows; ++r, to += slot.stride) {
      if (slot.add)
        for (int c = 0; c < columns; ++c) to[c] += part(r, c);
      else
        for (int c = 0; c < columns; ++c) to[c] = part(r, c);
    }
  }

  template <class Part>
  void add(BodyBlock* own, const TangentMatrix::Slot& slot, const Place& place, const Part& part) const {
    if (own != nullptr) {
      own->block<Part::RowsAtCompileTime, Part::ColsAtCompileTime>(place.row, place.column) += part;
      return;
    }
    double* to = target_.values[slot.other] + slot.offset + place.row * static_cast<int>(slot.stride) + place.column;
    constexpr int rows = Part::RowsAtCompileTime, columns = Part::ColsAtCompileTime;
    if (place.rows == rows && place.columns == columns)
      put(to, slot, part, rows, columns);
    else
      put(to, slot, part, place.rows, place.columns);
  }

  const partition::LocalNetwork& network_;
  BodySet& bodies_;
  const TangentTarget& target_;
};

}   // namespace cablenet::system
