#include "cablenet/bodies/body_box.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>

namespace cablenet::bodies {
namespace {

constexpr double thinnest_edge = 0.02;        // over the longest edge: thinner boxes can hardly be seen
constexpr double same_moment = 1e-9;          // over the largest moment: rounding makes equal moments differ by less
constexpr double density_of_point = 1000.0;   // of water [kg/m^3]

using Eigensystem = Eigen::SelfAdjointEigenSolver<Matrix3>;

/// The part of `axis` along all principal axes that belong to `moment`.  Where moments are equal, a single one of their
/// axes is arbitrary.
Vector3 part_in_eigenspace(const Eigensystem& principal, double moment, const Vector3& axis) {
  const Vector3& moments = principal.eigenvalues();
  Vector3 part = Vector3::Zero();
  for (int i = 0; i < 3; ++i) {
    const Vector3 direction = principal.eigenvectors().col(i);
    if (std::abs(moments[i] - moment) <= same_moment * moments[2]) part += direction.dot(axis) * direction;
  }
  return part;
}

/// The rotation R with the largest tr(R^T M), by Kabsch's method.
Matrix3 nearest_rotation(const Matrix3& m) {
  const Eigen::JacobiSVD<Matrix3> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3 u = svd.matrixU();
  if (u.determinant() * svd.matrixV().determinant() < 0) u.col(2) = -u.col(2);
  return u * svd.matrixV().transpose();
}

struct PrincipalAxes {
  Vector3 moments;
  Matrix3 axes;   ///< the columns are the principal axes, in body axes
};

PrincipalAxes principal_axes(const Matrix3& inertia) {
  const Eigensystem principal(inertia);
  std::array<int, 3> order{0, 1, 2};
  PrincipalAxes best{Vector3::Zero(), Matrix3::Zero()};
  double best_likeness = -2;
  do {
    Matrix3 parts;
    Vector3 moments;
    for (int i = 0; i < 3; ++i) {
      moments[i] = principal.eigenvalues()[order[static_cast<std::size_t>(i)]];
      parts.col(i) = part_in_eigenspace(principal, moments[i], Vector3::Unit(i));
    }
    const Matrix3 axes = nearest_rotation(parts);
    // The trace of `axes` would not do: where a part is zero, its column of `axes` is arbitrary.
    const double likeness = (axes.transpose() * parts).trace();
    if (likeness <= best_likeness) continue;
    best_likeness = likeness;
    best = {moments, axes};
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

}   // namespace

BodyBox body_box(double mass, const std::optional<Matrix3>& inertia) {
  if (!inertia || inertia->isZero(0)) {
    const double edge = std::cbrt(mass / density_of_point);
    return {Vector3::Constant(edge), Quaternion::Identity()};
  }
  const auto [moments, axes] = principal_axes(*inertia);
  const Vector3 squares = 6 / mass * (Vector3::Constant(moments.sum()) - 2 * moments);
  const Vector3 edges = squares.cwiseMax(0).cwiseSqrt();
  return {edges.cwiseMax(thinnest_edge * edges.maxCoeff()), Quaternion(axes)};
}

}   // namespace cablenet::bodies
