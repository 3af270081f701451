#pragma once
#include <optional>

#include "cablenet/base/linear_algebra.hpp"

/// What a rigid body looks like in pictures.  Tests: tests/parallel/body_box_test.cpp
namespace cablenet::output {

struct BodyBox {
  Vector3 edges;         ///< [m], along the box's own axes
  Quaternion attitude;   ///< unit: the box's axes to body axes
};

/// The uniform box of the same mass m and principal moments I1, I2, I3: a1^2 = 6 (I2 + I3 - I1) / m, and so on.  No
/// edge is shorter than 2 % of the longest, so that flat and thin ones can be seen.  Of all ways to name the principal
/// axes it takes the right-handed one closest to body axes; a diagonal inertia gives the identity.
/// @param mass     [kg], > 0
/// @param inertia  about the centre of gravity, body axes [kg m^2], positive semidefinite; none, or zero: a point mass,
///                 drawn as a cube of water
BodyBox body_box(double mass, const std::optional<Matrix3>& inertia);

}   // namespace cablenet::output
