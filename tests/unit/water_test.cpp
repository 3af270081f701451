#include "cablenet/environment/water.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cablenet::environment {
namespace {

constexpr double g = 9.81, pi = std::numbers::pi;

Wave wave(double height, double period, double depth, double heading, double phase) {
  const double omega = 2 * pi / period;
  return {0.5 * height, omega, wave_number(omega, depth, g), {std::cos(heading), std::sin(heading)}, phase};
}

Fluid sea(double depth) {
  Fluid fluid;
  fluid.density = 1025;
  fluid.surface = 0.3;
  fluid.depth = depth;
  fluid.current = {{-6, {0.1, 0.2, 0}}, {-2, {0.5, -0.1, 0}}, {3, {0.9, 0, 0}}};
  fluid.waves = {wave(1.2, 6, depth, 0.4, 0.3), wave(0.4, 3, depth, -1.1, 2)};
  return fluid;
}

/// The derivative of f at 0, by a difference of fourth order.
template <class F>
auto difference(F&& f, double h) {
  return ((8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h)).eval();
}

TEST(WaveNumber, MeetsTheDispersionFromShallowToDeep) {
  for (const double kh : {1e-6, 1e-3, 0.1, 0.7, 1.0, 1.9, 5.0, 40.0, 3000.0}) {
    const double depth = 13, k = kh / depth;
    EXPECT_NEAR(wave_number(std::sqrt(g * k * std::tanh(kh)), depth, g) / k, 1, 1e-14) << kh;
  }
}

TEST(WaveNumber, HasTheLimitsOfDeepAndShallowWater) {
  const double omega = 2 * pi / 8;
  EXPECT_NEAR(2 * pi / wave_number(omega, 1e4, g), g * 64 / (2 * pi), 1e-11);
  EXPECT_NEAR(wave_number(0.001, 2, g), 0.001 / std::sqrt(g * 2), 1e-10);
}

TEST(WaterMotion, StillWaterWithoutCurrentRests) {
  const WaterMotion motion = water_motion({}, Vector3(1, 2, 3), 4);
  EXPECT_EQ(motion.velocity.norm() + motion.acceleration.norm() + motion.velocity_slope.norm(), 0);
}

TEST(WaterMotion, CurrentIsLinearBetweenLayersAndConstantBeyond) {
  Fluid fluid;
  fluid.current = {{-6, {0.2, 0, 0}}, {-2, {1, -0.4, 0}}};
  EXPECT_TRUE(water_motion(fluid, {0, 0, -9}, 0).velocity.isApprox(Vector3(0.2, 0, 0)));
  EXPECT_TRUE(water_motion(fluid, {0, 0, -3}, 0).velocity.isApprox(Vector3(0.8, -0.3, 0)));
  EXPECT_TRUE(water_motion(fluid, {0, 0, -3}, 0).velocity_slope.col(2).isApprox(Vector3(0.2, -0.1, 0)));
  EXPECT_TRUE(water_motion(fluid, {0, 0, 5}, 0).velocity.isApprox(Vector3(1, -0.4, 0)));
  EXPECT_EQ(water_motion(fluid, {0, 0, 5}, 0).velocity_slope.norm(), 0);
  fluid.current.resize(1);
  EXPECT_TRUE(water_motion(fluid, {0, 0, 5}, 0).velocity.isApprox(Vector3(0.2, 0, 0)));
  EXPECT_FALSE(fluid.varies());
}

TEST(WaterMotion, DeepWaterMovesInCirclesThatDecay) {
  Fluid fluid;
  fluid.surface = 0;
  fluid.depth = 20000;
  fluid.waves = {wave(2, 8, fluid.depth, 0, 0)};
  const double omega = 2 * pi / 8, k = omega * omega / g, z = -7;
  for (const double t : {0.0, 1.3, 5.1}) {
    const WaterMotion motion = water_motion(fluid, {3, 1, z}, t);
    const double size = omega * std::exp(k * z), theta = k * 3 - omega * t;
    EXPECT_TRUE(motion.velocity.isApprox(size * Vector3(std::cos(theta), 0, std::sin(theta)), 1e-13));
    EXPECT_TRUE(motion.acceleration.isApprox(size * omega * Vector3(std::sin(theta), 0, -std::cos(theta)), 1e-13));
  }
  EXPECT_EQ(water_motion(fluid, {3, 1, -15000}, 0).velocity.norm(), 0);
}

TEST(WaterMotion, FiniteDepthIsCoshAndSinhAndTheBedStopsTheVertical) {
  Fluid fluid;
  fluid.surface = 2;
  fluid.depth = 10;
  fluid.waves = {wave(2, 8, 10, 0.7, 0.4)};
  const Wave& w = fluid.waves.front();
  const double z = -3, t = 2.1, theta = -w.frequency * t + w.phase;
  const WaterMotion motion = water_motion(fluid, {0, 0, 2 + z}, t);
  const double by = w.frequency / std::sinh(w.number * 10), at = w.number * (z + 10);
  EXPECT_NEAR(motion.velocity.x(), by * std::cosh(at) * std::cos(theta) * std::cos(0.7), 1e-14);
  EXPECT_NEAR(motion.velocity.y(), by * std::cosh(at) * std::cos(theta) * std::sin(0.7), 1e-14);
  EXPECT_NEAR(motion.velocity.z(), by * std::sinh(at) * std::sin(theta), 1e-14);
  EXPECT_EQ(water_motion(fluid, {0, 0, -8}, t).velocity.z(), 0);
  EXPECT_NEAR(water_motion(fluid, {0, 0, -8}, t).velocity.x(), by * std::cos(theta) * std::cos(0.7), 1e-14);
  EXPECT_TRUE(water_motion(fluid, {0, 0, -9}, t).velocity.isApprox(water_motion(fluid, {0, 0, -8}, t).velocity));
}

TEST(WaterMotion, ShallowWaterMovesAsOne) {
  Fluid fluid;
  fluid.surface = 0;
  fluid.depth = 1;
  const double omega = 1e-5, k = wave_number(omega, 1, g);
  fluid.waves = {{0.1, omega, k, {1, 0}, 0.5}};
  const Vector3 v = water_motion(fluid, {0, 0, -0.25}, 0).velocity;
  EXPECT_NEAR(v.x() / (0.1 * omega / k * std::cos(0.5)), 1, 1e-10);
  EXPECT_NEAR(v.z() / (0.1 * omega * 0.75 * std::sin(0.5)), 1, 1e-10);
}

TEST(WaterMotion, AboveTheStillSurfaceItIsThatAtTheSurface) {
  Fluid fluid = sea(12);
  fluid.current.clear();
  const WaterMotion at = water_motion(fluid, {1, 2, 0.3}, 0.8), above = water_motion(fluid, {1, 2, 0.9}, 0.8);
  EXPECT_TRUE(above.velocity.isApprox(at.velocity, 1e-14));
  EXPECT_TRUE(above.acceleration.isApprox(at.acceleration, 1e-14));
  EXPECT_EQ(above.velocity_slope.col(2).norm() + above.acceleration_slope.col(2).norm(), 0);
}

class WaterDerivatives : public testing::TestWithParam<double> {};

TEST_P(WaterDerivatives, AreThoseOfTheValues) {
  const Fluid fluid = sea(GetParam());
  const double t = 0.7;
  for (const double z : {-11.0, -5.0, -1.0, 0.2, 0.8, 5.0}) {
    const Vector3 x(1.5, -2.2, z);
    const WaterMotion motion = water_motion(fluid, x, t);
    for (int k = 0; k < 3; ++k) {
      const auto at = [&](double step) { return water_motion(fluid, x + step * Vector3::Unit(k), t); };
      const Vector3 v = difference([&](double s) { return at(s).velocity; }, 1e-3);
      const Vector3 a = difference([&](double s) { return at(s).acceleration; }, 1e-3);
      EXPECT_LE((v - motion.velocity_slope.col(k)).norm(), 1e-11);
      EXPECT_LE((a - motion.acceleration_slope.col(k)).norm(), 1e-11);
      const auto height = [&](double s) { return Vector3(0, 0, surface_height(fluid, x + s * Vector3::Unit(k), t).z); };
      EXPECT_NEAR(difference(height, 1e-3).z(), surface_height(fluid, x, t).slope(k), 1e-11);
    }
    const Vector3 rate = difference([&](double s) { return water_motion(fluid, x, t + s).velocity; }, 1e-3);
    EXPECT_LE((rate - motion.acceleration).norm(), 1e-11);
    if (z < 0.3) {
      EXPECT_NEAR(motion.velocity_slope.trace(), 0, 1e-14);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Depths, WaterDerivatives, testing::Values(11.5, 60.0, 8000.0));

/// In linear theory the elevation rises with the water's vertical velocity at the still surface.
TEST(FaintWaves, AreThoseThatTogetherAddLessThanTheShare) {
  Fluid fluid = sea(50);
  using Indices = std::vector<std::size_t>;
  EXPECT_EQ(faint_waves(fluid, 0.3, 1e-3), Indices{});
  fluid.waves = {wave(1e-3, 6, 50, 0, 0), wave(2, 8, 50, 0, 0), wave(1e-3, 7, 50, 0, 0)};
  // Of the velocity they have 0.67 and 0.57 parts of a thousand: only the fainter one stays below one thousandth.
  EXPECT_EQ(faint_waves(fluid, 0.3, 1e-3), Indices{2});
  EXPECT_EQ(faint_waves(fluid, 0.3, 2e-3), (Indices{0, 2}));
  fluid.waves[2].amplitude = 0;
  EXPECT_EQ(faint_waves(fluid, 0.3, 1e-4), Indices{2});
}

TEST(FaintWaves, DeepDownShortWavesAreFaint) {
  Fluid fluid = sea(50);
  fluid.waves = {wave(2, 12, 50, 0, 0), wave(2, 3, 50, 0, 0)};
  EXPECT_TRUE(faint_waves(fluid, 0.3, 1e-3).empty());
  // k = 0.447: e^(-0.447 20) = 1.3e-4 of twice the speed and eight times the acceleration.
  EXPECT_EQ(faint_waves(fluid, -20, 5e-3), std::vector<std::size_t>{1});
  EXPECT_TRUE(faint_waves(fluid, -5, 5e-3).empty());
}

TEST(SurfaceHeight, MovesWithTheWater) {
  Fluid fluid = sea(12);
  fluid.current.clear();
  const Vector3 x(1.5, -2.2, 0.3);
  const auto height = [&](double s) { return Vector3(0, 0, surface_height(fluid, x, 0.7 + s).z); };
  EXPECT_NEAR(difference(height, 1e-3).z(), water_motion(fluid, x, 0.7).velocity.z(), 1e-11);
  for (double t = 0; t < 20; t += 0.1) EXPECT_LE(std::abs(surface_height(fluid, x, t).z - 0.3), fluid.reach());
}

double smooth_step(double s) { return s <= 0 ? 0 : s >= 1 ? 1 : s * s * (3 - 2 * s); }

TEST(PieceWetness, IsTheMeanOfTheSmoothStep) {
  const double d = 0.4;
  for (const double q : {-0.9, -0.3, -0.15, 0.0, 0.1, 0.25, 0.8})
    for (const double h : {1e-9, 0.05, 0.2, 0.7, 3.0}) {
      double mean = 0;
      const int n = 20000;
      for (int i = 0; i < n; ++i) mean += smooth_step((q + h * ((i + 0.5) / n - 0.5)) / d + 0.5) / n;
      EXPECT_NEAR(piece_wetness(q, h, d).fraction, mean, 1e-8) << q << " " << h;
    }
}

TEST(PieceWetness, DerivativesAreThoseOfTheValuesAlsoOfShortPieces) {
  const double d = 0.4, step = 1e-4;
  using One = Eigen::Matrix<double, 1, 1>;
  for (const double q : {-0.33, -0.2, -0.12, 0.0, 0.17, 0.21, 0.6})
    for (const double h : {0.001, 0.05, 0.33, 0.9, 2.0}) {
      const Wetness wet = piece_wetness(q, h, d);
      const One by_q = difference([&](double s) { return One(piece_wetness(q + s, h, d).fraction); }, step);
      const One by_h = difference([&](double s) { return One(piece_wetness(q, h + s, d).fraction); }, step);
      EXPECT_NEAR(by_q(0), wet.by_depth, 1e-6) << q << " " << h;
      EXPECT_NEAR(by_h(0), wet.by_extent, 1e-6) << q << " " << h;
    }
}

TEST(PieceWetness, OfALevelPieceIsTheSmoothStepToRounding) {
  for (const double h : {0.0, 1e-17, 1e-12, 1e-9, 1e-6})
    for (const double q : {-0.5, -0.3, 0.1, 0.4999999, 0.5}) {
      EXPECT_NEAR(piece_wetness(q, h, 1).fraction, smooth_step(q + 0.5), 1e-12);
      EXPECT_NEAR(piece_wetness(q, h, 1).by_depth, 6 * (0.5 + q) * (0.5 - q), 4 * h + 1e-12);
      EXPECT_NEAR(piece_wetness(q, h, 1).by_extent, 0, 4 * h);
    }
}

TEST(PieceWetness, OfALongPieceIsItsWettedLength) {
  EXPECT_NEAR(piece_wetness(0.3, 2, 1e-3).fraction, (1 + 0.3) / 2, 1e-15);
  EXPECT_NEAR(piece_wetness(0, 2, 0.1).fraction, 0.5, 1e-15);
  EXPECT_EQ(piece_wetness(5, 2, 0.1).fraction, 1);
  EXPECT_EQ(piece_wetness(-5, 2, 0.1).fraction, 0);
}

TEST(SphereWetness, IsTheCapsVolume) {
  const double r = 0.7;
  for (const double q : {-0.6, -0.2, 0.0, 0.35, 0.69}) {
    const double cap = q + r, volume = pi * cap * cap * (3 * r - cap) / 3;
    EXPECT_NEAR(sphere_wetness(q, r).fraction, volume / (4 * pi * r * r * r / 3), 1e-15);
    EXPECT_NEAR(sphere_wetness(q, r).by_depth, pi * (r * r - q * q) / (4 * pi * r * r * r / 3), 1e-14);
  }
  EXPECT_EQ(sphere_wetness(0.8, r).fraction, 1);
  EXPECT_EQ(sphere_wetness(-0.8, r).fraction, 0);
  EXPECT_EQ(sphere_wetness(0.1, 0).fraction, 1);
  EXPECT_EQ(sphere_wetness(-0.1, 0).fraction, 0);
}

}   // namespace
}   // namespace cablenet::environment
