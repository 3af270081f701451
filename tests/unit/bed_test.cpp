#include "cablenet/environment/bed_contact.hpp"

#include <gtest/gtest.h>

namespace cablenet::environment {
namespace {

const Bed bed{-20, 3e5, 4e4, 0.6, 0, 0.02};
const ViscousFriction friction{bed.friction, bed.friction_velocity};
constexpr double area = 0.35, smoothing = 0.04;

BedForce at(const Vector3& x, const Vector3& v, double dt = 0) {
  return bed_force<false>(bed, area, smoothing, dt, x, v, friction);
}

TEST(BedForce, IsStiffnessTimesDepthBelowTheBedAndNothingAbove) {
  EXPECT_NEAR(at({1, 2, -20.1}, Vector3::Zero()).force.z(), area * 3e5 * 0.1, 1e-8);
  EXPECT_EQ(at({1, 2, -19.9}, {1, 2, -3}).force.norm(), 0);
  EXPECT_NEAR(at({1, 2, -20}, Vector3::Zero()).force.z(), area * 3e5 * smoothing / 4, 1e-9);
  EXPECT_NEAR(at({1, 2, -20.1}, {0, 0, -0.5}).force.z(), area * (3e5 * 0.1 + 4e4 * 0.5), 1e-8);
}

TEST(BedForce, IsContinuousWhereTheParabolaJoins) {
  for (const double p : {-smoothing, smoothing}) {
    const BedForce above = bed_force<true>(bed, area, smoothing, 0, {0, 0, -20 - p + 1e-12}, {0.3, 0, 0}, friction);
    const BedForce below = bed_force<true>(bed, area, smoothing, 0, {0, 0, -20 - p - 1e-12}, {0.3, 0, 0}, friction);
    EXPECT_LE((above.force - below.force).norm(), 1e-6);
    EXPECT_LE((above.by_x - below.by_x).norm(), 1e-4);
  }
}

TEST(BedForce, FrictionOpposesSlidingUpToCoulombs) {
  const Vector3 x(0, 0, -20.1);
  const double N = at(x, Vector3::Zero()).force.z();
  EXPECT_TRUE(at(x, {3e5, -4e5, 0}).force.isApprox(Vector3(-0.6 * 0.6 * N, 0.8 * 0.6 * N, N), 1e-9));
  EXPECT_NEAR(at(x, {0.02, 0, 0}).force.x(), -0.6 * N / std::sqrt(2), 1e-9 * N);
  EXPECT_EQ(at(x, Vector3::Zero()).force.head<2>().norm(), 0);
}

TEST(BedForce, NoFrictionWhereDampingHoldsTheNodeBack) {
  const Vector3 force = at({0, 0, -20.1}, {0.3, 0.2, 5}).force;
  EXPECT_LT(force.z(), 0);
  EXPECT_EQ(force.head<2>().norm(), 0);
}

/// The mean of the force at many instants on the path.
double mean_of_instants(double p, double rise, double dt) {
  constexpr int count = 20000;
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const double tau = ((i + 0.5) / count - 0.5) * dt;
    sum += at({0, 0, bed.level - p + rise * tau}, {0, 0, rise}).force.z();
  }
  return sum / count;
}

TEST(BedForce, OverAStepIsTheMeanOnThePath) {
  constexpr double dt = 0.1;
  for (const double p : {-0.05, -0.03, 0.001, 0.03, 0.3})
    for (const double rise : {-3.0, -0.4, -1e-3, 0.2, 3.0}) {
      const double mean = mean_of_instants(p, rise, dt);
      EXPECT_NEAR(at({0, 0, bed.level - p}, {0, 0, rise}, dt).force.z(), mean, 1e-4 * (1 + std::abs(mean)));
    }
  EXPECT_EQ(at({0, 0, bed.level + 0.1}, {0, 0, -1}, 0.1).force.norm(), 0);
  EXPECT_GT(at({0, 0, bed.level + 0.1}, {0, 0, -1}, 0.3).force.z(), 0);
}

/// However short the path is, no digits are lost.
TEST(BedForce, OverAVanishingStepIsThatOfTheInstant) {
  for (const double p : {-0.04, 0.01, 0.04, 0.3})
    for (double dt = 1e-4; dt > 1e-14; dt *= 0.1) {
      const Vector3 x(0, 0, bed.level - p), v(0.1, 0, -0.2);
      EXPECT_LE((at(x, v, dt).force - at(x, v).force).norm(), 1e-8 + 1e4 * dt);
    }
}

/// A node that comes down at any speed is stopped within the step.  The force that stops it grows from zero without a
/// jump.
TEST(BedForce, GrowsFromZeroWhereAPathTouchesTheBed) {
  constexpr double dt = 0.1;
  const double rise = -3;
  const auto force = [rise](double beyond) {
    return at({0, 0, bed.level + smoothing - 0.5 * dt * rise - beyond}, {0, 0, rise}, dt).force.z();
  };
  EXPECT_LE(force(0), 1e-12);
  EXPECT_LE(force(1e-3), 0.02 * area * bed.damping * 3);
  EXPECT_NEAR(force(2 * smoothing) / force(4 * smoothing), 1.0 / 3, 0.1);
}

void expect_derivatives(const Vector3& x, const Vector3& v, double dt) {
  const double h = 1e-6;
  const BedForce force = bed_force<true>(bed, area, smoothing, dt, x, v, friction);
  EXPECT_EQ(force.force, at(x, v, dt).force);
  for (int k = 0; k < 3; ++k) {
    const Vector3 step = h * Vector3::Unit(k);
    const Vector3 by_x = (at(x + step, v, dt).force - at(x - step, v, dt).force) / (2 * h);
    const Vector3 by_v = (at(x, v + step, dt).force - at(x, v - step, dt).force) / (2 * h);
    EXPECT_LE((by_x - force.by_x.col(k)).norm(), 1e-7 * (1e3 + force.by_x.norm()));
    EXPECT_LE((by_v - force.by_v.col(k)).norm(), 1e-7 * (1e3 + force.by_v.norm()));
  }
}

TEST(BedForce, DerivativesAreThoseOfTheForce) {
  for (const double dt : {0.0, 0.06, 0.53})
    for (const double p : {-0.05, -0.03, 0.001, 0.03, 0.3})
      for (const double rise : {-0.4, 0.0, 0.2, 30.0})
        expect_derivatives({3, -1, bed.level - p}, {0.013, -0.021, rise}, dt);
}

}   // namespace
}   // namespace cablenet::environment
