#pragma once
#include "cablenet/elements/cable_in_water_loads.hpp"
#include "cablenet/environment/bed_contact.hpp"
#include "element_loop.hpp"

/// What water and bed do to an element in the loop over elements.  All add to what the force laws have left.
namespace cablenet::system {

template <class Nodes, class Name>
elements::EndMotion end_motion(const Nodes& nodes, Name n1, Name n2) {
  using Const3 = Eigen::Map<const Vector3>;
  return {{Const3(nodes.x(n1)), Const3(nodes.x(n2))},
          {Const3(nodes.v(n1)), Const3(nodes.v(n2))},
          {Const3(nodes.a(n1)), Const3(nodes.a(n2))}};
}

/// Adds -K.
template <class Nodes>
void subtract_block(const TangentTarget& target, const TangentMatrix::Slot& slot, const Matrix3& K) {
  constexpr bool any = std::is_same_v<Nodes, AnyNodes>;
  if (any && slot.absent) return;
  double* to = (any && slot.other ? target.values[1] : target.values[0]) + slot.offset;
  for (int i = 0; i < 3; ++i, to += slot.stride) put_row(to, true, -K(i, 0), -K(i, 1), -K(i, 2));
}

/// What an evaluation of the surroundings is told.
struct SurroundingsTarget {
  TangentTarget tangent;
  Shift follow;
  bool with_residual;
};

/// Water's loads on an element between nodes with unknowns of their own.
template <class Water, class Nodes, bool with_tangent>
struct WaterWork {
  const partition::LocalNetwork& network;
  const Water& water;
  Nodes nodes;
  const SurroundingsTarget& target;

  [[gnu::flatten]] bool operator()(std::size_t i, const partition::LocalElement& e) const {
    const elements::CableInWater& cable = network.surroundings.in_water[static_cast<std::size_t>(e.material)];
    const auto n1 = Nodes::name(e, 0), n2 = Nodes::name(e, 1);
    const elements::EndLoads loads =
        elements::water_loads<with_tangent>(cable, e.length, end_motion(nodes, n1, n2), water, target.follow);
    if (target.with_residual) {
      Eigen::Map<Vector3>(nodes.r(n1)) -= loads.on[0];
      Eigen::Map<Vector3>(nodes.r(n2)) -= loads.on[1];
    }
    if constexpr (with_tangent)
      for (std::size_t k = 0; k < 4; ++k)
        subtract_block<Nodes>(target.tangent, target.tangent.slots[i][k], loads.by[k / 2][k % 2]);
    return true;
  }
};

/// A bed that gives way more easily, by as much as its smoothing is wider.
struct SoftBed {
  SoftBed(const environment::Bed& hard, double by) : bed(hard), softness(by) {
    bed.stiffness /= by;
    bed.damping /= by;
  }
  environment::Bed bed;
  double softness;
};

/// The bed's forces on an element's two nodes, each standing for half its length.
template <class Nodes, bool with_tangent>
struct BedWork {
  const partition::LocalNetwork& network;
  const SoftBed& soft;
  Nodes nodes;
  const SurroundingsTarget& target;
  double dt;

  [[gnu::flatten]] bool operator()(std::size_t i, const partition::LocalElement& e) const {
    const network::CableOnBed& cable = network.surroundings.on_bed[static_cast<std::size_t>(e.material)];
    const double smoothing = soft.softness * cable.smoothing;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto node = Nodes::name(e, k);
      const Eigen::Map<const Vector3> x(nodes.x(node)), v(nodes.v(node));
      if (x.z() - 0.5 * dt * std::abs(v.z()) > soft.bed.level + smoothing) continue;
      const environment::BedForce push =
          environment::bed_force<with_tangent>(soft.bed, 0.5 * cable.diameter * e.length, smoothing, dt, x, v);
      if (target.with_residual) Eigen::Map<Vector3>(nodes.r(node)) -= push.force;
      if constexpr (with_tangent)
        subtract_block<Nodes>(target.tangent, target.tangent.slots[i][3 * k],
                              target.follow.x * push.by_x + target.follow.v * push.by_v);
    }
    return true;
  }
};

}   // namespace cablenet::system
