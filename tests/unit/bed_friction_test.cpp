#include "cablenet/environment/held_friction.hpp"

#include <gtest/gtest.h>

#include <array>

#include <functional>

#include "cablenet/environment/bed_contact.hpp"

namespace cablenet::environment {
namespace {

constexpr double mu = 0.6, stiffness = 4e4, N = 7e3;

/// What slips after this way.  [m]
constexpr double longest = mu * N / stiffness;

/// Its grip is at z = 5, which does not matter.
const StickFriction spring{mu, stiffness, 0, {2, -1, 5}};

/// A way from the grip, in another direction than an axis.
Vector3 way(double length) { return length * Vector3(0.8, -0.6, 0); }
Vector3 place(double length) { return Vector3(2, -1, -20) + way(length); }

template <class Law>
FrictionForce at(const Law& law, double pressed, const Vector3& x, const Vector3& v = Vector3::Zero()) {
  return law.template at<true>(pressed, x, v);
}

TEST(StickFriction, IsASpringUpToCoulombsForce) {
  EXPECT_EQ(at(spring, N, place(0)).force, Vector3(0, 0, 0));
  for (const double part : {0.1, 0.5, 0.999})
    EXPECT_LE((at(spring, N, place(part * longest)).force + stiffness * way(part * longest)).norm(), 1e-9 * mu * N);
  for (const double part : {1.001, 3.0, 1e6})
    EXPECT_LE((at(spring, N, place(part * longest)).force + mu * N * way(1)).norm(), 1e-9 * mu * N);
  EXPECT_EQ(at(spring, N, place(0.3), {5, 5, 5}).force, at(spring, N, place(0.3)).force) << "velocities do not count";
}

TEST(StickFriction, IsContinuousWhereItSlips) {
  const Vector3 sticks = at(spring, N, place(longest * (1 - 1e-9))).force;
  const Vector3 slips = at(spring, N, place(longest * (1 + 1e-9))).force;
  EXPECT_LE((sticks - slips).norm(), 3e-9 * mu * N) << "the way differs by 2e-9, and the force by as much";
}

TEST(StickFriction, NothingHoldsWhatIsNotPressedToTheBed) {
  for (const double pressed : {0.0, -1.0}) {
    EXPECT_EQ(at(spring, pressed, place(1)).force.norm(), 0);
    EXPECT_EQ(at(spring, pressed, place(1)).by_x.norm(), 0);
    EXPECT_EQ(at(spring, pressed, place(1)).by_N.norm(), 0);
  }
}

TEST(StickFriction, TheGripFollowsWhatSlips) {
  EXPECT_EQ(spring.regripped(N, place(0.9 * longest)), spring.grip) << "what sticks leaves it";
  const Vector3 x = place(5 * longest), grip = spring.regripped(N, x);
  EXPECT_LE((along_bed(grip - spring.grip) - way(4 * longest)).norm(), 1e-12 * longest + 1e-15);
  const StickFriction after{mu, stiffness, 0, grip};
  EXPECT_LE((at(after, N, x).force - at(spring, N, x).force).norm(), 1e-9 * mu * N) << "the force is that before";
  EXPECT_LE((after.regripped(N, x) - grip).head<2>().norm(), 1e-15) << "a second time changes nothing";
  const Vector3 back = place(4.5 * longest);
  EXPECT_LE((at(after, N, back).force + stiffness * way(0.5 * longest)).norm(), 1e-9 * mu * N)
      << "on the way back it is a spring again";
}

TEST(StickFriction, WhatIsNotPressedToTheBedTakesItsGripAlong) {
  for (const double pressed : {0.0, -3.0})
    EXPECT_EQ(along_bed(spring.regripped(pressed, place(1)) - place(1)).norm(), 0);
  EXPECT_EQ(spring.regripped(0, place(0)), spring.grip) << "nor is anything divided by a way of 0";
}

/// The central difference of a function of x along the axis k.  It errs by h^2 and by eps/h.
double slope(const std::function<double(const Vector3&)>& function, const Vector3& x, int k, double h) {
  const Vector3 step = h * Vector3::Unit(k);
  return (function(x + step) - function(x - step)) / (2 * h);
}

TEST(StickFriction, ThePotentialsDerivativeIsTheForce) {
  for (const double length : {0.3 * longest, 0.9 * longest, 1.5 * longest, 20 * longest})
    for (int k = 0; k < 3; ++k) {
      const auto potential = [](const Vector3& x) { return spring.potential(N, x); };
      // h is a part 1e-4 of the way: the difference errs by 1e-8 of the force, and by rounding, 1e-16/1e-5 of it.
      const double found = slope(potential, place(length), k, 1e-4 * longest);
      EXPECT_NEAR(-found, at(spring, N, place(length)).force[k], 1e-7 * mu * N) << length / longest;
    }
  EXPECT_EQ(spring.potential(-1, place(1)), 0);
  EXPECT_NEAR(spring.potential(N, place(longest)), 0.5 * stiffness * longest * longest, 1e-12 * stiffness);
}

/// Each slope of a law against differences, by x, by v and by N.
template <class Law>
void expect_slopes(const Law& law, const Vector3& x, const Vector3& v) {
  const double h = 1e-6, bound = 1e-6 * (stiffness + mu * N);
  const FrictionForce found = at(law, N, x, v);
  for (int k = 0; k < 3; ++k) {
    const Vector3 step = h * Vector3::Unit(k);
    const Vector3 by_x = (at(law, N, x + step, v).force - at(law, N, x - step, v).force) / (2 * h);
    const Vector3 by_v = (at(law, N, x, v + step).force - at(law, N, x, v - step).force) / (2 * h);
    EXPECT_LE((by_x - found.by_x.col(k)).norm(), bound);
    EXPECT_LE((by_v - found.by_v.col(k)).norm(), bound);
  }
  const Vector3 by_N = (at(law, N * (1 + h), x, v).force - at(law, N * (1 - h), x, v).force) / (2 * h * N);
  EXPECT_LE((by_N - found.by_N).norm(), 1e-6);
}

TEST(StickFriction, SlopesAreThoseOfTheForce) {
  for (const double length : {0.5 * longest, 2 * longest, 10 * longest})
    expect_slopes(spring, place(length), {1, 2, 3});
}

/// The cautious slope keeps what resists across the slip, and resists as much along it.
TEST(StickFriction, TheCautiousSlopeDiffersAlongTheSlipAlone) {
  StickFriction cautious = spring;
  cautious.is_cautious = true;
  const Vector3 x = place(4 * longest), along = way(1), across_slip(0.6, 0.8, 0);
  const FrictionForce exact = at(spring, N, x), found = at(cautious, N, x);
  const double secant = mu * N / (4 * longest);
  EXPECT_EQ(found.force, exact.force);
  EXPECT_EQ(found.by_N, exact.by_N);
  EXPECT_LE(((found.by_x - exact.by_x) * across_slip).norm(), 1e-12 * secant);
  EXPECT_LE((exact.by_x * along).norm(), 1e-12 * secant);
  EXPECT_LE((found.by_x * along + secant * along).norm(), 1e-12 * secant);
  EXPECT_EQ((found.by_x.col(2).norm() + found.by_x.row(2).norm()), 0);
  EXPECT_EQ(at(cautious, N, place(0.5 * longest)).by_x, at(spring, N, place(0.5 * longest)).by_x) << "what sticks";
}

TEST(ViscousFriction, OpposesSlidingUpToCoulombs) {
  const ViscousFriction viscous{mu, 0.02};
  const Vector3 x(1, 2, 3);
  EXPECT_EQ(at(viscous, N, x).force.norm(), 0) << "it holds nothing still";
  EXPECT_NEAR(at(viscous, N, x, {0.02, 0, 9}).force.x(), -mu * N / std::sqrt(2), 1e-12 * N);
  EXPECT_LE((at(viscous, N, x, {3e5, -4e5, 1}).force - mu * N * Vector3(-0.6, 0.8, 0)).norm(), 1e-9 * N);
  EXPECT_EQ(at(viscous, -1, x, {1, 0, 0}).force.norm(), 0);
  for (const double speed : {0.0, 0.01, 0.05}) expect_slopes(viscous, x, {speed, -2 * speed, 0.3});
}

/// Newton's method has gone from one side of where the node sticks to the other: the chord between the two sides.
TEST(StickFriction, WhereItHasTurnedRoundTheSlopeIsTheChords) {
  constexpr double N = 3, way = 5 * mu * N / stiffness;
  std::array<double, 2> last{};
  StickFriction turning = spring;
  turning.last = last.data();
  const Vector3 there(2 + way, -1, 0), back(2 - 2 * way, -1, 0);
  EXPECT_EQ(turning.at<true>(N, there, Vector3::Zero()).by_x(0, 0), 0);
  const FrictionForce found = turning.at<true>(N, back, Vector3::Zero());
  const double change = found.force.x() - turning.at<false>(N, there, Vector3::Zero()).force.x();
  EXPECT_NEAR(found.by_x(0, 0), change / (back - there).x(), 1e-12 * stiffness);
  EXPECT_EQ(turning.at<true>(N, back, Vector3::Zero()).by_x(0, 0), 0);
}

TEST(HeldFriction, TakesItsOwnPressureAlone) {
  const HeldFriction<StickFriction> held{spring, N};
  for (const double length : {0.5 * longest, 3 * longest})
    for (const double pressed : {-5.0, 0.0, 1e9}) {
      EXPECT_EQ(at(held, pressed, place(length)).force, at(spring, N, place(length)).force);
      EXPECT_EQ(at(held, pressed, place(length)).by_x, at(spring, N, place(length)).by_x);
      EXPECT_EQ(at(held, pressed, place(length)).by_N.norm(), 0);
    }
  expect_slopes(held, place(3 * longest), Vector3::Zero());
}

constexpr double area = 0.35, smoothing = 0.04;
const Bed bed{-20, 3e5, 4e4, mu, 0, 0};

/// The whole force on a node that is pressed to the bed and held by a spring: N follows z and the vertical velocity,
/// and friction follows N.
template <class Law>
void expect_derivatives(const Law& law, const Vector3& x, const Vector3& v, double dt) {
  const double h = 1e-7;
  const auto force = [&](const Vector3& x, const Vector3& v) {
    return bed_force<false>(bed, area, smoothing, dt, x, v, law).force;
  };
  const BedForce found = bed_force<true>(bed, area, smoothing, dt, x, v, law);
  EXPECT_EQ(found.force, force(x, v));
  // A difference errs by eps F/h, with forces F up to 4e4, and by h^2.
  const double bound = 1e-6 * (1e3 + found.by_x.norm() + found.by_v.norm());
  for (int k = 0; k < 3; ++k) {
    const Vector3 step = h * Vector3::Unit(k);
    EXPECT_LE(((force(x + step, v) - force(x - step, v)) / (2 * h) - found.by_x.col(k)).norm(), bound) << k;
    EXPECT_LE(((force(x, v + step) - force(x, v - step)) / (2 * h) - found.by_v.col(k)).norm(), bound) << k;
  }
}

TEST(BedForce, DerivativesWithFrictionBySpringsAreThoseOfTheForce) {
  for (const double dt : {0.0, 0.06})
    for (const double p : {-0.03, 0.001, 0.03, 0.3})
      for (const double rise : {-0.4, 0.0, 0.05}) {
        const Vector3 v(0.1, 0.2, rise), x(3, 1, bed.level - p);
        const double pressed = bed_force<false>(bed, area, smoothing, dt, x, v, NoFriction{}).force.z();
        if (pressed <= 0) continue;
        for (const double part : {0.4, 3.0}) {
          const StickFriction near{mu, stiffness, 0.07 * stiffness, x - way(part * mu * pressed / stiffness)};
          expect_derivatives(near, x, v, dt);
          expect_derivatives(HeldFriction<StickFriction>{near, 2 * pressed}, x, v, dt);
        }
        expect_derivatives(ViscousFriction{mu, 0.2}, x, v, dt);
      }
}

/// Where friction slips, its force follows N: a push down makes it larger.
TEST(BedForce, FrictionThatSlipsFollowsThePressure) {
  const StickFriction slipping{mu, stiffness, 0, {-100, 0, 0}};
  const BedForce found = bed_force<true>(bed, area, smoothing, 0, {0, 0, -20.1}, {0, 0, 0}, slipping);
  EXPECT_NEAR(found.force.x(), -mu * found.force.z(), 1e-12 * found.force.z());
  EXPECT_NEAR(found.by_x(0, 2), -mu * found.by_x(2, 2), 1e-9 * std::abs(found.by_x(2, 2)));
  EXPECT_LT(found.by_x(2, 2), 0);
  EXPECT_NEAR(found.by_v(0, 2), -mu * found.by_v(2, 2), 1e-9 * std::abs(found.by_v(2, 2)));
}

/// What statics holds rubs above the bed, too.
TEST(BedForce, HeldFrictionActsWhereverTheNodeIs) {
  const HeldFriction<StickFriction> held{{mu, stiffness, 0, {-100, 0, 0}}, N};
  const Vector3 force = bed_force<false>(bed, area, smoothing, 0, {0, 0, 3}, {0, 0, 0}, held).force;
  EXPECT_LE((force - Vector3(-mu * N, 0, 0)).norm(), 1e-12 * N);
}

}   // namespace
}   // namespace cablenet::environment
