#pragma once
#include <optional>

#include "cablenet/base/linear_algebra.hpp"

/// Pictures show a rigid body as a box.  The box's corners are also where the body touches the bed.
/// Tests: tests/unit/body_box_test.cpp
namespace cablenet::bodies {

struct BodyBox {
  Vector3 edges;         ///< lengths along the box's own axes [m]
  Quaternion attitude;   ///< unit quaternion, the box's axes to body axes
};

/// The uniform box with the body's mass m and principal moments of inertia I1, I2, I3.  Its edge along the first
/// principal axis has a1^2 = 6 (I2 + I3 - I1) / m; the others follow by cyclic exchange of the indices.  No edge is
/// shorter than 2 % of the longest, so that flat and thin boxes can be seen.  The principal axes are named such that
/// they are right-handed and as close to the body axes as can be; a diagonal inertia gives the identity.
/// @param mass     [kg], > 0
/// @param inertia  about the centre of gravity, body axes [kg m^2], positive semidefinite.  None or zero stands for a
///                 point mass, which is drawn as a cube with the density of water.
BodyBox body_box(double mass, const std::optional<Matrix3>& inertia);

}   // namespace cablenet::bodies
