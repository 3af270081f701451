#include "point_water_term.hpp"

#include "cablenet/bodies/body_in_water.hpp"
#include "item_loops.hpp"

namespace cablenet::system {
namespace {

struct PointWaterKernel {
  static constexpr bool owns_slots = true;

  const partition::LocalNetwork& network;
  const environment::Fluid& fluid;
  double t;

  template <bool with_tangent, class Nodes, class Key>
  bool evaluate(std::size_t i, Key node, const Nodes& nodes, NodeResponse& out) const {
    const bodies::PointLoad load = bodies::point_load(network.wet_points[i].water, fluid, t, network.gravity,
                                                      {nodes.x(node), nodes.v(node), nodes.a(node)});
    out = {-load.force, -load.by_x, -load.by_v, -load.by_a};
    return true;
  }
};

}   // namespace

void PointWaterTerm::add(Evaluation& evaluation) {
  if (slots_.empty()) return;
  const PointWaterKernel kernel{network_, fluid(evaluation.situation), evaluation.time()};
  add_to_nodes(evaluation, kernel, network_.wet_points, slots_);
}

}   // namespace cablenet::system
