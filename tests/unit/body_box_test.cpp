#include "cablenet/bodies/body_box.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace cablenet;
using cablenet::bodies::body_box;

namespace {

Vector3 moments_of_box(double mass, const Vector3& edges) {
  const Vector3 squares = edges.cwiseAbs2();
  return mass / 12 * (Vector3::Constant(squares.sum()) - squares);
}

Matrix3 inertia_of_box(double mass, const Vector3& edges, const Matrix3& axes) {
  return axes * moments_of_box(mass, edges).asDiagonal() * axes.transpose();
}

Matrix3 turn(double degrees, const Vector3& axis) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis.normalized()).toRotationMatrix();
}

}   // namespace

TEST(BodyBox, ADiagonalInertiaGivesItsBoxUnturnedWhateverItsOrder) {
  for (const Vector3& edges : {Vector3(1, 2, 3), Vector3(3, 1, 2), Vector3(2, 3, 1), Vector3(3, 2, 1), Vector3(2, 2, 1),
                               Vector3(1, 2, 2), Vector3(2, 1, 2), Vector3(2, 2, 2)}) {
    const auto box = body_box(7, inertia_of_box(7, edges, Matrix3::Identity()));
    EXPECT_LT((box.edges - edges).norm(), 1e-12) << edges.transpose();
    EXPECT_LT(box.attitude.angularDistance(Quaternion::Identity()), 1e-12) << edges.transpose();
  }
}

TEST(BodyBox, TurnedBoxesComeBack) {
  for (const Vector3& edges : {Vector3(1, 2, 3), Vector3(3, 1, 2), Vector3(2, 3, 1)})
    for (const double degrees : {-40.0, -1.0, 1e-3, 20.0, 40.0})
      for (const Vector3& axis : {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1), Vector3(1, -2, 1)}) {
        const Matrix3 axes = turn(degrees, axis);
        const auto box = body_box(0.3, inertia_of_box(0.3, edges, axes));
        EXPECT_LT((box.edges - edges).norm(), 1e-10) << edges.transpose() << " " << degrees;
        EXPECT_LT((box.attitude.toRotationMatrix() - axes).norm(), 1e-10) << edges.transpose() << " " << degrees;
      }
}

TEST(BodyBox, AnyTurnGivesTheSameInertiaBackByTheSmallestTurn) {
  const Vector3 edges(1, 2, 3);
  for (int degrees = 0; degrees < 360; degrees += 5) {
    const Matrix3 inertia = inertia_of_box(2, edges, turn(degrees, Vector3(1, 2, -0.5)));
    const auto box = body_box(2, inertia);
    EXPECT_LT((inertia_of_box(2, box.edges, box.attitude.toRotationMatrix()) - inertia).norm(), 1e-10) << degrees;
    EXPECT_LT(box.attitude.angularDistance(Quaternion::Identity()), 1.1) << degrees;
    EXPECT_NEAR(box.attitude.norm(), 1, 1e-14);
  }
}

TEST(BodyBox, ARodIsNotTurnedAboutItself) {
  for (const double degrees : {0.0, 10.0, 44.0}) {
    const Matrix3 axes = turn(degrees, Vector3(0, 1, 0));
    const auto box = body_box(5, inertia_of_box(5, Vector3(4, 0.5, 0.5), axes));
    EXPECT_LT((box.edges - Vector3(4, 0.5, 0.5)).norm(), 1e-6) << degrees;
    EXPECT_LT((box.attitude.toRotationMatrix() - axes).norm(), 1e-6) << degrees;
  }
}

TEST(BodyBox, RoundingDoesNotTurnEqualMoments) {
  Matrix3 inertia = moments_of_box(5, Vector3(4, 0.5, 0.5)).asDiagonal();
  inertia(1, 2) = inertia(2, 1) = 1e-15;
  EXPECT_LT(body_box(5, inertia).attitude.angularDistance(Quaternion::Identity()), 1e-7);
  inertia = Matrix3::Identity();
  inertia(0, 1) = inertia(1, 0) = -1e-15;
  EXPECT_LT(body_box(5, inertia).attitude.angularDistance(Quaternion::Identity()), 1e-7);
}

TEST(BodyBox, FlatAndImpossibleOnesCanBeSeen) {
  const auto plate = body_box(12, Matrix3(Vector3(1, 1, 2).asDiagonal()));
  EXPECT_LT((plate.edges - Vector3(1, 1, 0.02)).norm(), 1e-12);
  const auto impossible = body_box(12, Matrix3(Vector3(1, 1, 3).asDiagonal()));
  EXPECT_NEAR(impossible.edges[2], 0.02 * impossible.edges[0], 1e-12);
  EXPECT_TRUE(impossible.edges.allFinite());
}

TEST(BodyBox, APointMassIsACubeOfWater) {
  for (const std::optional<Matrix3>& inertia : {std::optional<Matrix3>(), std::optional<Matrix3>(Matrix3::Zero())}) {
    const auto box = body_box(8, inertia);
    EXPECT_LT((box.edges - Vector3::Constant(0.2)).norm(), 1e-15);
    EXPECT_EQ(box.attitude.coeffs(), Quaternion::Identity().coeffs());
  }
}
