#include "cablenet/bodies/body_in_water.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cablenet/environment/water.hpp"

namespace cablenet::bodies {
namespace {

using environment::Fluid;

constexpr double g = 9.81, t = 0.9;
const PointInWater buoy{900, 130, 450, 0.8};
const BodyInWater hull{{30, 0, 50}, {200, 700, 900}, {300, 500, 800}, 0.9};
const Matrix3 R = Quaternion(0.7, 0.2, -0.4, 0.3).normalized().toRotationMatrix();

Fluid sea() {
  Fluid fluid;
  fluid.density = 1025;
  fluid.surface = 0.2;
  fluid.depth = 15;
  fluid.current = {{-8, {0.2, 0, 0}}, {4, {1, -0.4, 0.1}}};
  fluid.waves = {{0.6, 1.3, environment::wave_number(1.3, 15, g), {0.8, 0.6}, 0.4}};
  return fluid;
}

PointMotion motion_at(double z) { return {{0.4, -1.1, z}, {0.3, 0.7, -0.4}, {1.2, -0.3, 0.8}}; }

template <class Load>
void expect_exact(const Load& load_at, double z) {
  const PointMotion m = motion_at(z);
  const PointLoad load = load_at(m);
  const double h = 1e-5;
  const std::array<std::pair<Vector3 PointMotion::*, Matrix3>, 3> slopes{
      {{&PointMotion::x, load.by_x}, {&PointMotion::v, load.by_v}, {&PointMotion::a, load.by_a}}};
  for (const auto& [part, slope] : slopes)
    for (int k = 0; k < 3; ++k) {
      PointMotion plus = m, minus = m;
      (plus.*part)(k) += h;
      (minus.*part)(k) -= h;
      const Vector3 by = (load_at(plus).force - load_at(minus).force) / (2 * h);
      EXPECT_LE((by - slope.col(k)).norm(), 1e-7 * (load.force.norm() + slope.norm())) << z;
    }
}

constexpr std::array heights{-9.0, -3.0, -0.4, 0.1, 0.7, 3.0};

TEST(PointInWater, DerivativesAreThoseOfTheForce) {
  Fluid endless = sea();
  endless.surface.reset();
  endless.waves.clear();
  for (const double z : heights) {
    expect_exact([fluid = sea()](const PointMotion& m) { return point_load(buoy, fluid, t, g, m); }, z);
    expect_exact([&](const PointMotion& m) { return point_load(buoy, endless, t, g, m); }, z);
  }
}

TEST(BodyInWater, DerivativesAreThoseOfTheForce) {
  for (const double z : heights)
    expect_exact([fluid = sea()](const PointMotion& m) { return body_load(hull, fluid, t, R, m); }, z);
}

TEST(BodyInWater, ItsTurningIsDerivedToo) {
  const Fluid fluid = sea();
  Matrix3 dR;
  dR << 0.3, -0.2, 0.5, 0.1, 0.7, -0.4, 0.6, 0.2, -0.1;
  const double h = 1e-6;
  for (const double z : heights) {
    const auto force = [&](double s) { return body_load(hull, fluid, t, R + s * dR, motion_at(z)).force; };
    const Vector3 by = (force(h) - force(-h)) / (2 * h);
    const BodyLoad load = body_load(hull, fluid, t, R, motion_at(z));
    EXPECT_LE((by - load.by_rotation(R, dR)).norm(), 1e-7 * (1 + by.norm())) << z;
  }
}

TEST(PointInWater, FloatsHalfUnderWhereItWeighsHalf) {
  Fluid still;
  still.surface = 0;
  EXPECT_TRUE(point_load(buoy, still, 0, g, {Vector3::Zero(), Vector3::Zero(), Vector3::Zero()})
                  .force.isApprox(Vector3(0, 0, 450 * g)));
  EXPECT_TRUE(point_load(buoy, still, 0, g, {{0, 0, -1}, {2, 0, 0}, {0, 3, 0}})
                  .force.isApprox(Vector3(-130 * 4, -450 * 3, 900 * g)));
  EXPECT_EQ(point_load(buoy, still, 0, g, {{0, 0, 1}, {2, 0, 0}, {0, 3, 0}}).force.norm(), 0);
}

/// Waves push a point at rest by the Froude-Kriloff force and by its added mass: (rho V + added) a_water.
TEST(PointInWater, WavesPushWhatRests) {
  Fluid fluid = sea();
  fluid.current.clear();
  const Vector3 x(0.4, -1.1, -6);
  const environment::WaterMotion water = environment::water_motion(fluid, x, t);
  const PointInWater dragless{900, 0, 450, 0.8};
  const Vector3 force = point_load(dragless, fluid, t, g, {x, Vector3::Zero(), Vector3::Zero()}).force;
  EXPECT_TRUE(force.isApprox(1350 * water.acceleration + Vector3(0, 0, 900 * g), 1e-13));
}

TEST(BodyInWater, DragAndAddedMassFollowItsAxes) {
  Fluid still;
  const Vector3 v = R * Vector3(0, -2, 0), a = R * Vector3(0, 0, 3);
  const Vector3 force = body_load(hull, still, 0, R, {Vector3::Zero(), v, a}).force;
  EXPECT_TRUE((R.transpose() * force).isApprox(Vector3(0, 700 * 4, -800 * 3), 1e-13));
}

}   // namespace
}   // namespace cablenet::bodies
