#pragma once
#include "cablenet/bodies/body_data.hpp"

namespace cablenet::bodies {

/// How the unknowns y of an attitude follow a small rotation vector in the world's axes; zero rows where there are
/// fewer than four.  A moment M is the generalised force on y whose product with each column is M's part along that
/// axis.
Eigen::Matrix<double, 4, 3> small_turn(const Properties&, const Vector4& y);

}   // namespace cablenet::bodies
