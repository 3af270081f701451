#include "cablenet/bodies/rigid_body.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cablenet/bodies/rotation.hpp"

namespace cablenet::bodies {
namespace {

Properties body(Rotation rotation) {
  Properties p;
  p.rotation = rotation;
  p.inertia << 0.4, -0.05, -0.03, -0.05, 0.5, 0.02, -0.03, 0.02, 0.6;
  p.torque = Vector3(0.3, -0.2, 0.1);
  return p;
}

Properties with_drag(Properties p) {
  p.linear_drag = Vector3(0.7, 0, 0.4);
  p.quadratic_drag = Vector3(0, 1.3, 0.9);
  return p;
}

const Quaternion tilted = Quaternion(0.7, 0.2, -0.4, 0.3).normalized();

RotationState stage_of(Rotation rotation) {
  RotationState s = rotation_state(rotation, tilted, Vector3(0.6, -0.3, 0.8));
  const int n = rotation_unknowns(rotation);
  for (int i = 0; i < n; ++i) {
    s.y(i) += 0.01 * (i + 1);
    s.ddy(i) = 0.7 - 0.5 * i;
  }
  return s;
}

StepRule rule_of(bool conserving) { return conserving ? StepRule{0.5, 0.02, true} : StepRule{0.6, 0.02, false}; }

struct Way {
  Rotation rotation;
  bool conserving;
  bool at_rest = false;
};

class RigidBodyMaps : public testing::TestWithParam<Way> {};

struct Stage {
  StageMotion motion;
  StageForces forces;
};

Stage evaluated(const Properties& p, const Start& start, const StepRule& rule, const RotationState& s,
                const Shift* shift = nullptr) {
  Stage stage;
  evaluate(p, start, rule, s, shift, true, stage.motion, stage.forces);
  return stage;
}

TEST_P(RigidBodyMaps, DerivativesAreThoseOfTheValues) {
  const auto [rotation, conserving, at_rest] = GetParam();
  const Properties p = conserving ? body(rotation) : with_drag(body(rotation));
  const RotationState begin = rotation_state(rotation, tilted, Vector3(0.5, -0.2, 0.9));
  const Start start = start_of(p, begin.y, begin.dy);
  RotationState s = stage_of(rotation);
  if (at_rest) s.dy.setZero();
  const Shift shift{1, 100, 2e4};
  const auto [motion, forces] = evaluated(p, start, rule_of(conserving), s, &shift);
  const Vector3 T(0.7, -0.4, 0.9);
  const double h = 1e-6,
               size = std::max(forces.by_own.cwiseAbs().maxCoeff(), motion.by_acceleration.cwiseAbs().maxCoeff());
  for (int k = 0; k < rotation_unknowns(rotation); ++k) {
    const auto at = [&, rotate = conserving](double step) {
      RotationState moved = s;
      moved.y(k) += step * shift.x;
      moved.dy(k) += step * shift.v;
      moved.ddy(k) += step * shift.a;
      return evaluated(p, start, rule_of(rotate), moved);
    };
    const Stage plus = at(h), minus = at(-h);
    const auto error = [h](const auto& after, const auto& before, const auto& by) {
      return ((after - before) / (2 * h) - by).cwiseAbs().maxCoeff();
    };
    const auto part = [k](const Stacked& stacked) -> Matrix3 { return stacked.block<3, 3>(3 * k, 0); };
    EXPECT_LE(error(plus.motion.position, minus.motion.position, part(motion.by_position)), 1e-6 * size);
    EXPECT_LE(error(plus.motion.velocity, minus.motion.velocity, part(motion.by_velocity)), 1e-6 * size);
    EXPECT_LE(error(plus.motion.acceleration, minus.motion.acceleration, part(motion.by_acceleration)), 1e-6 * size);
    EXPECT_LE(error(plus.forces.lever, minus.forces.lever, part(forces.by_lever)), 1e-6 * size);
    EXPECT_LE(error(plus.forces.turn.transpose() * T, minus.forces.turn.transpose() * T,
                    turn_slope(rotation, forces, T).col(k)),
              1e-6 * size);
    EXPECT_LE(error(plus.forces.own, minus.forces.own, forces.by_own.col(k)), 1e-6 * size);
  }
}

INSTANTIATE_TEST_SUITE_P(All, RigidBodyMaps,
                         testing::Values(Way{Rotation::quaternion, false}, Way{Rotation::quaternion, true},
                                         Way{Rotation::quaternion, true, true}, Way{Rotation::euler, false}));

class RigidBodyRotation : public testing::TestWithParam<Rotation> {};

TEST_P(RigidBodyRotation, StateHoldsAttitudeAndAngularVelocity) {
  const Vector3 w(0.6, -0.3, 0.8);
  const RotationState s = rotation_state(GetParam(), tilted, w);
  const Properties p = body(GetParam());
  EXPECT_LE(attitude(p, s.y).angularDistance(tilted), 1e-14);
  EXPECT_LE((start_of(p, s.y, s.dy).R - tilted.toRotationMatrix()).norm(), 1e-14);
  EXPECT_LE((angular_velocity(GetParam(), s) - w).norm(), 1e-14);
}

TEST_P(RigidBodyRotation, TheQuaternionsSignIsTheOneGiven) {
  for (const double sign : {1.0, -1.0}) {
    const Quaternion given(Eigen::Vector4d(sign * tilted.coeffs()));
    const RotationState s = rotation_state(GetParam(), given, Vector3::Zero());
    EXPECT_LE((attitude(body(GetParam()), s.y).coeffs() - given.coeffs()).norm(), 1e-14);
  }
}

/// The velocity and acceleration of an attachment are the first and second derivatives of its position.
TEST_P(RigidBodyRotation, AttachmentsMoveAsTheAttitudeTurns) {
  const Properties p = body(GetParam());
  const RotationState s = stage_of(GetParam());
  const double h = 1e-4;
  const auto position = [&](double t) {
    RotationState later = s;
    later.y += t * s.dy + 0.5 * t * t * s.ddy;
    return evaluated(p, {}, {}, later).motion.position;
  };
  const auto [now, forces] = evaluated(p, {}, {}, s);
  EXPECT_LE(((position(h) - position(-h)) / (2 * h) - now.velocity).norm(), 1e-7);
  EXPECT_LE(((position(h) - 2 * now.position + position(-h)) / (h * h) - now.acceleration).norm(), 1e-6);
  EXPECT_LE((now.position * now.position.transpose() - Matrix3::Identity()).norm(), 1e-14);
}

/// Apart from the quaternion's gauge force, the own forces are turn^T R (I w' + w x I w + drag - torque).
TEST_P(RigidBodyRotation, OwnForcesAreEulersEquations) {
  const Properties p = with_drag(body(GetParam()));
  const RotationState s = stage_of(GetParam());
  const auto [now, forces] = evaluated(p, {}, {}, s);
  const Vector3 w = angular_velocity(GetParam(), s);
  const Matrix3 R = now.position, spin = R.transpose() * now.acceleration;
  const Vector3 dw(0.5 * (spin(2, 1) - spin(1, 2)), 0.5 * (spin(0, 2) - spin(2, 0)), 0.5 * (spin(1, 0) - spin(0, 1)));
  const Vector3 drag = (p.linear_drag + p.quadratic_drag.cwiseProduct(w.cwiseAbs())).cwiseProduct(w);
  const Vector3 torque = p.inertia * dw + w.cross(p.inertia * w) + drag - p.torque;
  Vector4 own = forces.own - forces.turn.transpose() * (R * torque);
  if (GetParam() == Rotation::quaternion) own -= own.dot(s.y) / s.y.squaredNorm() * s.y;
  EXPECT_LE(own.norm(), 1e-13);
}

INSTANTIATE_TEST_SUITE_P(All, RigidBodyRotation, testing::Values(Rotation::quaternion, Rotation::euler));

/// Whatever the step, a force at an attachment does the same work as torque on the turning body as it does along the
/// attachment's path.
TEST(RigidBodyConserving, LeversDoTheWorkOfTheirForces) {
  const Properties p = body(Rotation::quaternion);
  const RotationState begin = rotation_state(Rotation::quaternion, tilted, Vector3(3, -2, 4));
  const Start start = start_of(p, begin.y, begin.dy);
  const double dt = 0.3;
  const Vector3 turn = dt * Vector3(2.5, -1.5, 4.5);
  const Quaternion end = tilted * Quaternion(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
  RotationState s;
  s.y << end.w(), end.vec();
  s.dy = (s.y - begin.y) / dt;
  s.y = 0.5 * (s.y + begin.y);
  const auto [motion, forces] = evaluated(p, start, {0.5, dt, true}, s);
  const Vector3 r(0.3, -0.7, 0.2), F(5, -3, 7);
  const double along = F.dot(end * r - tilted * r);
  const double turned = torque_of(forces.lever, F * r.transpose()).dot(tilted * turn);
  EXPECT_NEAR(along, turned, 1e-13 * std::abs(along));
  EXPECT_LE((motion.velocity * r * dt - (end * r - tilted * r)).norm(), 1e-14);
}

TEST(RigidBodyConserving, EndByTurnAndByMomentumAgreeWhereTheEquationsHold) {
  Properties p = body(Rotation::quaternion);
  p.inertia = 0.5 * Matrix3::Identity();
  p.torque.setZero();
  const Vector3 w(0.3, 0.5, -0.8);
  const RotationState begin = rotation_state(Rotation::quaternion, tilted, w);
  const Start start = start_of(p, begin.y, begin.dy);
  const double dt = 0.4;
  const Quaternion end = tilted * Quaternion(Eigen::AngleAxisd(dt * w.norm(), w.normalized()));
  Vector4 y1;
  y1 << end.w(), end.vec();
  EXPECT_LE((end_by_turn(start, dt, y1) - w).norm(), 1e-14);
  EXPECT_LE((end_by_momentum(p, start, dt, y1) - w).norm(), 1e-14);
}

TEST(RigidBody, TorqueOfSeveralForcesIsTheirSum) {
  const Matrix3 lever = tilted.toRotationMatrix();
  const Vector3 r1(1, 2, 3), F1(-2, 0.5, 1), r2(0.4, -1, 0.2), F2(3, 1, -2);
  const Moments moments = F1 * r1.transpose() + F2 * r2.transpose();
  const Vector3 expected = (lever * r1).cross(F1) + (lever * r2).cross(F2);
  EXPECT_LE((torque_of(lever, moments) - expected).norm(), 1e-14);
}

TEST(RigidBody, OnlyEulerAnglesAreEverSingular) {
  const Quaternion up(Eigen::AngleAxisd(EIGEN_PI / 2, Vector3::UnitY()));
  const RotationState q = rotation_state(Rotation::quaternion, up, Vector3::Zero());
  EXPECT_EQ(distance_from_singular(Rotation::quaternion, q.y), 1);
  Vector4 y(0.3, EIGEN_PI / 2, 0.1, 0);
  EXPECT_NEAR(distance_from_singular(Rotation::euler, y), 0, 1e-15);
  EXPECT_EQ(distance_from_singular(Rotation::none, y), 1);
}

}   // namespace
}   // namespace cablenet::bodies
