#pragma once
#include "cablenet/bodies/body_data.hpp"

/// What the tangent needs of nodes that bodies carry, as data; carrying.hpp has what computes it.
namespace cablenet::bodies {

/// Row-major, as the matrix that such parts go to.
template <int rows, int columns>
using RowMajor = Eigen::Matrix<double, rows, columns, Eigen::RowMajor>;

/// How a carried node's motion follows its body's attitude, by its unknowns; zero columns where those are fewer than
/// four.  The body's position comes on top as it is.
struct CarriedTangent {
  RowMajor<3, 4> x = RowMajor<3, 4>::Zero(), v = x, a = x;
  Matrix34 load = x;   ///< A force F is the generalised force load^T F on the attitude.
  int unknowns = 0;    ///< of the attitude
};

/// A body's block of the tangent while its parts are collected, and a column to spare.
using BodyBlock = RowMajor<7, 8>;

}   // namespace cablenet::bodies
