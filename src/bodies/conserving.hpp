#pragma once
#include "cablenet/bodies/rigid_body.hpp"

namespace cablenet::bodies {

/// evaluate() for a conserving step.  Its derivatives are written out by hand, because every step of the
/// energy-momentum scheme takes them for every body.
void evaluate_conserving(const Properties&, const Start&, double dt, const RotationState& stage, const Shift* shift,
                         bool with_velocity, StageMotion& motion, StageForces& forces);

}   // namespace cablenet::bodies
