#pragma once
#include "attached_work.hpp"
#include "surroundings_work.hpp"

/// What water and bed do to an element that ends on a body.
namespace cablenet::system {

template <class Water, bool with_tangent>
struct AttachedWaterWork {
  const partition::LocalNetwork& network;
  const Water& water;
  AnyNodes nodes;
  const SurroundingsTarget& target;
  AttachedBlocks blocks;

  bool operator()(std::size_t i, const partition::LocalElement& e) const {
    const elements::CableInWater& cable = network.surroundings.in_water[static_cast<std::size_t>(e.material)];
    const elements::EndMotion motion = end_motion(nodes, e.node[0], e.node[1]);
    const auto loads = [&](const Shift& follow) {
      return elements::water_loads<with_tangent>(cable, e.length, motion, water, follow);
    };
    const elements::EndLoads by_x = loads({1, 0, 0});
    for (std::size_t k = 0; k < 2; ++k) add_attached_force(network, nodes, e.node[k], -by_x.on[k]);
    if constexpr (with_tangent) {
      const elements::EndLoads by_v = loads({0, 1, 0}), by_a = loads({0, 0, 1});
      for (std::size_t r = 0; r < 2; ++r)
        for (std::size_t c = 0; c < 2; ++c)
          blocks.add(e.node[r], e.node[c], target.tangent.slots[i][2 * r + c],
                     {-by_x.by[r][c], -by_v.by[r][c], -by_a.by[r][c]}, target.follow);
    }
    return true;
  }
};

template <bool with_tangent>
struct AttachedBedWork {
  const partition::LocalNetwork& network;
  const SoftBed& soft;
  AnyNodes nodes;
  const SurroundingsTarget& target;
  AttachedBlocks blocks;
  double dt;

  bool operator()(std::size_t i, const partition::LocalElement& e) const {
    const network::CableOnBed& cable = network.surroundings.on_bed[static_cast<std::size_t>(e.material)];
    const double smoothing = soft.softness * cable.smoothing;
    for (std::size_t k = 0; k < 2; ++k) {
      const LocalNode node = e.node[k];
      const Eigen::Map<const Vector3> x(nodes.x(node)), v(nodes.v(node));
      const environment::BedForce push =
          environment::bed_force<with_tangent>(soft.bed, 0.5 * cable.diameter * e.length, smoothing, dt, x, v);
      add_attached_force(network, nodes, node, -push.force);
      if constexpr (with_tangent)
        blocks.add(node, node, target.tangent.slots[i][3 * k], {-push.by_x, -push.by_v, Matrix3::Zero()},
                   target.follow);
    }
    return true;
  }
};

}   // namespace cablenet::system
