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
  int size(int node) const {
    if (!network_.is_carried(node)) return 3;
    const int body = network_.carried_at(node).body;
    return 3 + bodies::rotation_unknowns(network_.bodies[static_cast<std::size_t>(body)].properties.rotation);
  }
  bool share_body(int one, int other) const {
    return network_.is_carried(one) && network_.is_carried(other) &&
           network_.carried_at(one).body == network_.carried_at(other).body;
  }

  void write_block(int row, int column, bool diagonal, const TangentMatrix::Slot& slot,
                   const AttachedTangent& t) const {
    BodyBlock* const own = share_body(row, column) ? bodies_.block_at(row) : nullptr;
    if (slot.absent && own == nullptr) return;
    const double sign = diagonal ? 1 : -1, m = (diagonal ? 2 : 1) * t.mass;
    Eigen::Matrix<double, 3, 7> by = Eigen::Matrix<double, 3, 7>::Zero();
    by.leftCols<3>() = sign * (t.k_x + target_.shift_v * t.k_v);
    by.leftCols<3>().diagonal().array() += m * (target_.shift_a + t.mass_damping * target_.shift_v);
    if (network_.is_carried(column)) {
      const CarriedTangent& c = bodies_.carried_tangent(column);
      by.rightCols<4>() = sign * (t.k_x * c.x + t.k_v * c.v) + m * (c.a + t.mass_damping * c.v);
    }
    BodyBlock block = BodyBlock::Zero();
    block.topRows<3>() = by;
    if (network_.is_carried(row)) block.bottomRows<4>() = bodies_.carried_tangent(row).load.transpose() * by;
    if (own != nullptr)
      *own += block;
    else
      put(slot, block, size(row), size(column));
  }

  void put(const TangentMatrix::Slot& slot, const BodyBlock& block, int rows, int columns) const {
    double* to = target_.values[slot.other] + slot.offset;
    for (int r = 0; r < rows; ++r, to += slot.stride)
      for (int c = 0; c < columns; ++c) to[c] = slot.add ? to[c] + block(r, c) : block(r, c);
  }

  const partition::LocalNetwork& network_;
  BodySet& bodies_;
  const TangentTarget& target_;
};

}   // namespace cablenet::system
