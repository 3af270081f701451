#include "point_force_term.hpp"

#include "item_loops.hpp"

namespace cablenet::system {

using ConstVector = Eigen::Map<const Vector3>;

struct PointForceTerm::Kernel {
  static constexpr bool owns_slots = true;
  const std::vector<ForcedPoint>& points;
  double t;

  template <bool with_tangent, class Nodes, class Key>
  bool evaluate(std::size_t i, Key, const Nodes&, NodeResponse& out) const {
    out.on = -points[i].force.at(t);
    if constexpr (with_tangent) {
      out.x.setZero();
      out.v.setZero();
      out.a.setZero();
    }
    return true;
  }
};

PointForceTerm::PointForceTerm(const partition::LocalNetwork& network) {
  for (const auto& [node, point] : network.points)
    if (point.force_law) points_.push_back({node, *point.force_law, network.position[node], network.position[node]});
  slots_.resize(points_.size());
}

void PointForceTerm::begin_step(Evaluation& evaluation) {
  const AnyNodes nodes{evaluation.data};
  for (ForcedPoint& point : points_) point.start = ConstVector(nodes.x(point.node));
}

void PointForceTerm::add(Evaluation& evaluation) {
  if (points_.empty()) return;
  add_to_nodes(evaluation, Kernel{points_, evaluation.load_time()}, points_, slots_);
  const AnyNodes nodes{evaluation.data};
  for (ForcedPoint& point : points_) point.stage = ConstVector(nodes.x(point.node));
}

void PointForceTerm::end_step(const StepEnd& end) {
  const double middle = end.stage.t + 0.5 * end.stage.dt;
  for (const ForcedPoint& point : points_)
    work_ += point.force.at(middle).dot(point.stage - point.start) / end.stage.alpha_f;
}

void PointForceTerm::add_scales(ForceSums& sums) const {
  for (const ForcedPoint& point : points_) sums.load += point.force.largest() * point.force.largest();
}

Vector3 PointForceTerm::node_force(const LocalState& state, LocalNode node) const {
  for (const ForcedPoint& point : points_)
    if (point.node == node) return -point.force.at(state.t);
  return Vector3::Zero();
}

}   // namespace cablenet::system
