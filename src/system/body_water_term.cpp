#include "body_water_term.hpp"

namespace cablenet::system {

void BodyWaterTerm::add(Evaluation& evaluation) {
  if (!has_rates() || network_.own_bodies == 0) return;
  evaluation.complete();
  const AnyNodes nodes{evaluation.data};
  for (int b = 0; b < network_.own_bodies; ++b) {
    const partition::LocalBody& body = network_.bodies[at(b)];
    const bool turns = evaluation.bodies.unknowns(b) > 0;
    const Matrix3 R = turns ? evaluation.bodies.forces(b).lever : Matrix3(body.properties.attitude.toRotationMatrix());
    const bodies::BodyLoad load = bodies::body_load(*body.water, fluid(evaluation.situation), evaluation.time(), R,
                                                    {nodes.x(body.node), nodes.v(body.node), nodes.a(body.node)});
    if (evaluation.has_residual) nodes.r(body.node) -= load.force;
    if (evaluation.has_tangent) add_slopes(b, load, R, evaluation);
  }
}

/// Steadied bodies' loads do not follow attitudes.
void BodyWaterTerm::add_slopes(int b, const bodies::BodyLoad& load, const Matrix3& R, Evaluation& evaluation) const {
  const Shift& shift = evaluation.target.shift;
  bodies::BodyBlock& block = evaluation.carried.blocks[at(b)];
  block.topLeftCorner<3, 3>() -= shift.x * load.by_x + shift.v * load.by_v + shift.a * load.by_a;
  if (evaluation.target.steadiness > 0) return;
  for (int k = 0; k < evaluation.bodies.unknowns(b); ++k)
    block.block<3, 1>(0, 3 + k) -= load.by_rotation(R, evaluation.bodies.forces(b).by_lever.middleRows<3>(3 * k));
}

}   // namespace cablenet::system
