#include "point_force_term.hpp"

namespace cablenet::system {

PointForceTerm::PointForceTerm(const partition::LocalNetwork& network) : Term(network) {
  for (const auto& [node, point] : network.points)
    if (point.force_law) points_.push_back({node, *point.force_law, network.position[node], network.position[node]});
}

void PointForceTerm::begin_step(Evaluation& evaluation) {
  for (ForcedPoint& point : points_) point.start = AnyNodes{evaluation.data}.x(point.node);
}

void PointForceTerm::add(Evaluation& evaluation) {
  const AnyNodes nodes{evaluation.data};
  for (ForcedPoint& point : points_) {
    point.stage = nodes.x(point.node);
    if (evaluation.has_residual) nodes.r(point.node) -= point.force.at(evaluation.load_time());
  }
}

void PointForceTerm::end_step(const StepEnd& end) {
  const double middle = end.stage.t + 0.5 * end.stage.dt;
  for (const ForcedPoint& point : points_)
    work_ += point.force.at(middle).dot(point.stage - point.start) / end.stage.alpha_f;
}

void PointForceTerm::add_scales(const LocalState&, ForceSums& sums) const {
  for (const ForcedPoint& point : points_) sums.load += square(point.force.largest());
}

Vector3 PointForceTerm::node_force(const LocalState& state, LocalNode node) const {
  for (const ForcedPoint& point : points_)
    if (point.node == node) return -point.force.at(state.t);
  return Vector3::Zero();
}

}   // namespace cablenet::system
