#include "cablenet/elements/cable_in_water_loads.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace cablenet::elements {
namespace {

using environment::Fluid;

const CableInWater rope{4.0, 3.1, 55.0, 2.5, 0.08};
constexpr double L = 1.6, g = 9.81;
const Shift follow{1, 40, 1700};

struct CableInWaterTest : testing::Test {
  /// Each test has the same states, whichever other tests run.
  void SetUp() override { std::srand(1); }
};

EndMotion random_motion(double z) {
  EndMotion m;
  for (int i : {0, 1}) {
    m.x[i] = Vector3::Random() + Vector3(0.3, -0.7, z);
    m.v[i] = Vector3::Random();
    m.a[i] = 3 * Vector3::Random();
  }
  return m;
}

EndMotion moved(EndMotion m, int node, const Vector3& step, const Shift& f) {
  m.x[node] += f.x * step;
  m.v[node] += f.v * step;
  m.a[node] += f.a * step;
  return m;
}

template <class Water>
void expect_exact_tangent(const CableInWater& c, const EndMotion& m, const Water& water, const Shift& f, double h) {
  const EndLoads loads = water_loads<true>(c, L, m, water, f);
  double size = 0;
  for (int i : {0, 1})
    for (int j : {0, 1}) size = std::max(size, loads.by[i][j].norm());
  for (int j : {0, 1})
    for (int k = 0; k < 3; ++k) {
      const auto at = [&](double step) {
        return water_loads<false>(c, L, moved(m, j, step * Vector3::Unit(k), f), water, f);
      };
      // These differences are of fourth order.
      const EndLoads a = at(h), b = at(-h), a2 = at(2 * h), b2 = at(-2 * h);
      for (int i : {0, 1}) {
        const Vector3 difference = (8 * (a.on[i] - b.on[i]) - (a2.on[i] - b2.on[i])) / (12 * h);
        EXPECT_LE((difference - loads.by[i][j].col(k)).norm(), 1e-7 * size + 1e-9) << i << j << k;
      }
    }
}

Fluid sea() {
  Fluid fluid;
  fluid.density = 1025;
  fluid.surface = 0.4;
  fluid.depth = 9;
  fluid.current = {{-8, {0.2, 0, 0}}, {-3, {0.5, 0.3, 0.1}}, {20, {1, -0.4, 0}}};
  const double k = environment::wave_number(1.3, fluid.depth, g);
  fluid.waves = {{0.6, 1.3, k, {0.8, 0.6}, 0.4}, {0.2, 2.9, environment::wave_number(2.9, 9, g), {0, -1}, 2.1}};
  return fluid;
}

TEST_F(CableInWaterTest, TangentIsExactInUniformWater) {
  for (int n = 0; n < 20; ++n) {
    expect_exact_tangent(rope, random_motion(0), UniformWater{{0.9, -0.2, 0.3}, g}, follow, 1e-5);
    expect_exact_tangent(rope, random_motion(0), UniformWater{{0.9, -0.2, 0.3}, g}, {1, 0, 0}, 1e-4);
  }
}

TEST_F(CableInWaterTest, TangentIsExactInWaves) {
  const Fluid fluid = sea();
  for (int n = 0; n < 20; ++n)
    expect_exact_tangent(rope, random_motion(-5), VaryingWater<false>{fluid, 0.7, g}, {1, 3, 11}, 1e-4);
}

TEST_F(CableInWaterTest, TangentIsExactAcrossTheSurface) {
  const Fluid fluid = sea();
  int partly_wet = 0;
  for (int n = 0; n < 60; ++n) {
    EndMotion m = random_motion(0.4);
    if (n % 2 == 0)
      // The cable is nearly level, so that the surface crosses its diameter.
      for (Vector3& x : m.x) x.z() = environment::surface_height(fluid, x, 0.7).z + 0.03 * (x.z() - 0.4);
    expect_exact_tangent(rope, m, VaryingWater<true>{fluid, 0.7, g}, {1, 3, 11}, 1e-5);
    const double wet = wet_part({wet_half(fluid, 0.7, 0.08, m.x, 0), wet_half(fluid, 0.7, 0.08, m.x, 1)}).length();
    partly_wet += wet > 0 && wet < 1;
  }
  EXPECT_GE(partly_wet, 30);
}

TEST_F(CableInWaterTest, TangentIsExactAtRestAlongTheFlowAndWithoutDrag) {
  const CableInWater bare{4.0, 3.1, 0, 0, 0.08};
  EndMotion m;
  m.x = {Vector3(0, 0, 0), Vector3(L, 0, 0)};
  m.v = {Vector3::Zero(), Vector3::Zero()};
  m.a = {Vector3(1, 2, -1), Vector3(0, 3, 1)};
  expect_exact_tangent(bare, m, UniformWater{Vector3::Zero(), g}, follow, 1e-5);
  expect_exact_tangent(bare, random_motion(0), UniformWater{Vector3::Zero(), g}, follow, 1e-5);
  for (const double along : {0.0, 0.8}) {
    const EndLoads loads = water_loads<true>(rope, L, m, UniformWater{{along, 0, 0}, g}, follow);
    for (int i : {0, 1})
      for (int j : {0, 1}) EXPECT_TRUE(loads.by[i][j].allFinite());
  }
}

/// All kinds of water give the same loads where they describe the same water.
TEST_F(CableInWaterTest, UniformWaterIsVaryingWaterWithOneLayer) {
  Fluid fluid;
  fluid.surface = 50;
  fluid.current = {{0, {0.9, -0.2, 0.3}}};
  const EndMotion m = random_motion(0);
  const EndLoads uniform = water_loads<true>(rope, L, m, UniformWater{{0.9, -0.2, 0.3}, g}, follow);
  const EndLoads endless = water_loads<true>(rope, L, m, VaryingWater<false>{fluid, 0, g}, follow);
  const EndLoads deep = water_loads<true>(rope, L, m, VaryingWater<true>{fluid, 0, g}, follow);
  for (int i : {0, 1}) {
    EXPECT_TRUE(endless.on[i].isApprox(uniform.on[i], 1e-14) && deep.on[i].isApprox(uniform.on[i], 1e-14));
    for (int j : {0, 1})
      EXPECT_TRUE(endless.by[i][j].isApprox(uniform.by[i][j], 1e-14) &&
                  deep.by[i][j].isApprox(uniform.by[i][j], 1e-14));
  }
}

EndMotion resting(const Vector3& x1, const Vector3& x2) {
  const Vector3 zero = Vector3::Zero();
  return {{x1, x2}, {zero, zero}, {zero, zero}};
}

const Shift still_follow{1, 0, 0};

Vector3 total(const CableInWater& c, const EndMotion& m, const auto& water) {
  const EndLoads loads = water_loads<false>(c, L, m, water, still_follow);
  return loads.on[0] + loads.on[1];
}

TEST_F(CableInWaterTest, DragAcrossAndAlongTheFlow) {
  const CableInWater weightless{0, 0, 55, 2.5, 0.08};
  const UniformWater water{{1.5, 0, 0}, g};
  EXPECT_TRUE(total(weightless, resting({0, 0, 0}, {0, L, 0}), water).isApprox(Vector3(55 * 2.25 * L, 0, 0), 1e-13));
  EXPECT_TRUE(total(weightless, resting({0, 0, 0}, {L, 0, 0}), water).isApprox(Vector3(2.5 * 2.25 * L, 0, 0), 1e-13));
  // At 60 degrees un = 1.5 sin 60 across and ut = 1.5 cos 60 along the cable.  A stretched cable has no more drag.
  const Vector3 e(0.5, 0, std::sqrt(0.75)), across(std::sqrt(0.75), 0, -0.5);
  const Vector3 expected = 55 * 2.25 * 0.75 * L * across + 2.5 * 2.25 * 0.25 * L * e;
  EXPECT_TRUE(total(weightless, resting(Vector3::Zero(), 1.2 * L * e), water).isApprox(expected, 1e-13));
}

/// A cable along its circular path has no flow across it, although the ends of the chords have.
TEST_F(CableInWaterTest, DragIsThatOfTheFlowAtTheMiddle) {
  const double radius = 3, angle = 0.4;
  EndMotion m = resting(radius * Vector3(std::cos(angle), -std::sin(angle), 0),
                        radius * Vector3(std::cos(angle), std::sin(angle), 0));
  for (int i : {0, 1}) m.v[i] = Vector3(0, 0, 1).cross(m.x[i]);
  const CableInWater floating{0, 0, 55, 2.5, 0.08};
  const EndLoads loads = water_loads<false>(floating, L, m, UniformWater{Vector3::Zero(), g}, still_follow);
  const double speed = radius * std::cos(angle);
  for (int i : {0, 1}) EXPECT_LE((loads.on[i] + Vector3(0, 0.5 * L * 2.5 * speed * speed, 0)).norm(), 1e-13);
}

TEST_F(CableInWaterTest, OppositeMotionOfTheEndsMeetsAddedMassAlone) {
  EndMotion m = resting({0, 0, 0}, {L, 0, 0});
  m.v = {Vector3(0, 2, -1), Vector3(0, -2, 1)};
  m.a = {Vector3(0, 3, 0), Vector3(0, -3, 0)};
  const CableInWater floating{0, 3.1, 55, 2.5, 0.08};
  const EndLoads loads = water_loads<false>(floating, L, m, UniformWater{Vector3::Zero(), g}, still_follow);
  for (int i : {0, 1}) EXPECT_LE((loads.on[i] + 3.1 * L / 6 * m.a[i]).norm(), 1e-13);
}

TEST_F(CableInWaterTest, DragAcrossSlowsWhatTurnsTheChord) {
  EndMotion m = resting({0, 0, 0}, {L, 0, 0});
  m.v = {Vector3(0, -0.3, 0.2), Vector3(0, 0.3, -0.2)};
  const CableInWater floating{0, 0, 55, 2.5, 0.08};
  const EndLoads loads = water_loads<false>(floating, L, m, UniformWater{{0, 0, 1.5}, g}, still_follow);
  const Vector3 drag(0, 0, 55 * 1.5 * 1.5 * L), couple = turning_share / 12 * 55 * 1.5 * L * (m.v[1] - m.v[0]);
  EXPECT_LE((loads.on[0] - 0.5 * drag - couple).norm(), 1e-13);
  EXPECT_LE((loads.on[1] - 0.5 * drag + couple).norm(), 1e-13);
}

/// The drag on an upright cable acts at the middle of its wetted part, whichever end is wet, and has the flow there.
TEST_F(CableInWaterTest, DragActsAtTheMiddleOfTheWettedPart) {
  Fluid fluid;
  fluid.surface = 0;
  fluid.current = {{-L, {0, 0, 0}}, {0, {1.5, 0, 0}}};
  const CableInWater thin{0, 0, 55, 2.5, 1e-14 * L};
  for (const double wet : {0.5, 1.0})
    for (const bool turned : {false, true}) {
      EndMotion m = resting({0, 0, -wet * L}, {0, 0, (1 - wet) * L});
      if (turned) std::swap(m.x[0], m.x[1]);
      const EndLoads loads = water_loads<false>(thin, L, m, VaryingWater<true>{fluid, 0, g}, still_follow);
      const double speed = 1.5 * (1 - 0.5 * wet), drag = 55 * speed * speed * wet * L;
      EXPECT_NEAR(loads.on[0].x() + loads.on[1].x(), drag, 1e-12);
      EXPECT_NEAR(loads.on[turned ? 0 : 1].x(), 0.5 * wet * drag, 1e-12) << wet << turned;
    }
}

/// Nothing jumps where an element gets wet, becomes wet all over, or has its half at the surface.
TEST_F(CableInWaterTest, LoadsAndTangentAreContinuousWhileAnElementSinks) {
  Fluid fluid = sea();
  fluid.waves.clear();   // their motion has a corner at the still surface
  const VaryingWater<true> water{fluid, 0.7, g};
  for (const double tilt : {0.0, 0.01, 0.6}) {
    const auto at = [&](double z) {
      EndMotion m = resting({0, 0, z}, {0.9 * L, 0.1 * L, z + tilt * L});
      m.v = {Vector3(0.3, -0.5, 0.2), Vector3(-0.4, 0.1, 0.6)};
      m.a = {Vector3(1, 2, 3), Vector3(-2, 1, 0)};
      return water_loads<true>(rope, L, m, water, {1, 3, 11});
    };
    const double step = 1e-4;
    int changed = 0;
    for (double z = -0.7; z < 1.2; z += step) {
      const EndLoads a = at(z), b = at(z + step);
      for (int i : {0, 1}) {
        EXPECT_LE((b.on[i] - a.on[i]).norm(), 500 * step);
        for (int j : {0, 1}) EXPECT_LE((b.by[i][j] - a.by[i][j]).norm(), 1.5e4 * step);
        changed += b.on[i] != a.on[i];
      }
    }
    EXPECT_GE(changed, 1000);
    EXPECT_EQ(at(1.2).on[0].norm() + at(1.2).by[0][0].norm(), 0);
  }
}

TEST_F(CableInWaterTest, AddedMassIsConsistentAndActsAcrossAlone) {
  const CableInWater light{0, 3.1, 0, 0, 0.08};
  const Vector3 e = Vector3(2, -1, 2) / 3;
  const Matrix3 across = Matrix3::Identity() - e * e.transpose();
  const EndMotion m = resting({1, 0, 0}, Vector3(1, 0, 0) + 1.3 * L * e);
  const EndLoads loads = water_loads<true>(light, L, m, UniformWater{Vector3::Zero(), g}, {1, 0, 1});
  for (int i : {0, 1})
    for (int j : {0, 1})
      EXPECT_TRUE(loads.by[i][j].isApprox(-3.1 * L / 6 * (i == j ? 2 : 1) * across, 1e-13)) << i << j;
  const Matrix3 sum = loads.by[0][0] + loads.by[0][1] + loads.by[1][0] + loads.by[1][1];
  EXPECT_LE((sum * e).norm(), 1e-14);
  EXPECT_TRUE(sum.isApprox(-3.1 * L * across, 1e-13));
}

TEST_F(CableInWaterTest, BuoyancyIsThatOfTheWettedLength) {
  Fluid fluid;
  fluid.surface = 0;
  const VaryingWater<true> water{fluid, 0, g};
  const CableInWater thin{4, 0, 0, 0, 1e-4 * L};
  const double full = 4 * L * g;
  EXPECT_NEAR(total(thin, resting({0, 0, -L / 2}, {0, 0, L / 2}), water).z(), full / 2, 1e-12);
  EXPECT_NEAR(total(thin, resting({0, 0, 0.2 * L}, {0, 0, -0.8 * L}), water).z(), 0.8 * full, 1e-12);
  EXPECT_NEAR(total(thin, resting({0, 0, -L}, {L, 0, -L}), water).z(), full, 1e-12);
  EXPECT_EQ(total(thin, resting({0, 0, L}, {L, 0, L}), water).norm(), 0);
  // A level cable's wetness is the smooth step: it lies a quarter of its diameter below the surface.
  EXPECT_NEAR(total(rope, resting({0, 0, -0.02}, {L, 0, -0.02}), water).z(), full * 0.75 * 0.75 * 1.5, 1e-12);
  EXPECT_NEAR(total(rope, resting({0, 0, 0}, {L, 0, 0}), water).z(), full / 2, 1e-12);
}

TEST_F(CableInWaterTest, WavesPushWhatRests) {
  Fluid fluid = sea();
  fluid.current.clear();
  fluid.waves.resize(1);
  fluid.waves[0].direction = {1, 0};
  const CableInWater dragless{4, 3.1, 0, 0, 0.08};
  // The cable lies along the crest, so that the water's acceleration is the same everywhere on it.
  const EndMotion m = resting({0.5, 0, -4}, {0.5, L, -4});
  const environment::WaterMotion motion = environment::water_motion(fluid, m.x[0], 0.7);
  const Vector3 expected = L * (7.1 * motion.acceleration + Vector3(0, 0, 4 * g));
  EXPECT_TRUE(total(dragless, m, VaryingWater<true>{fluid, 0.7, g}).isApprox(expected, 1e-13));
}

TEST_F(CableInWaterTest, LoadsTurnWithTheWorldAboutTheVertical) {
  const Matrix3 turn = Eigen::AngleAxisd(0.83, Vector3::UnitZ()).toRotationMatrix();
  const Fluid fluid = sea();
  Fluid turned = fluid;
  for (auto& layer : turned.current) layer.velocity = turn * layer.velocity;
  for (auto& wave : turned.waves) wave.direction = turn.topLeftCorner<2, 2>() * wave.direction;
  for (const double z : {-6.0, -0.5, 0.4}) {
    const EndMotion m = random_motion(z);
    EndMotion n = m;
    for (auto* part : {&n.x, &n.v, &n.a})
      for (Vector3& value : *part) value = turn * value;
    const EndLoads loads = water_loads<true>(rope, L, m, VaryingWater<true>{fluid, 0.7, g}, follow);
    const EndLoads after = water_loads<true>(rope, L, n, VaryingWater<true>{turned, 0.7, g}, follow);
    for (int i : {0, 1}) {
      EXPECT_LE((after.on[i] - turn * loads.on[i]).norm(), 1e-12 * (1 + loads.on[i].norm()));
      for (int j : {0, 1})
        EXPECT_LE((after.by[i][j] - turn * loads.by[i][j] * turn.transpose()).norm(),
                  1e-12 * (1 + loads.by[i][j].norm()));
    }
  }
}

TEST_F(CableInWaterTest, ExchangingTheEndsExchangesTheLoads) {
  const Fluid fluid = sea();
  const EndMotion m = random_motion(0.2);
  const EndMotion n{{m.x[1], m.x[0]}, {m.v[1], m.v[0]}, {m.a[1], m.a[0]}};
  const EndLoads loads = water_loads<true>(rope, L, m, VaryingWater<true>{fluid, 0.7, g}, follow);
  const EndLoads after = water_loads<true>(rope, L, n, VaryingWater<true>{fluid, 0.7, g}, follow);
  for (int i : {0, 1}) {
    EXPECT_TRUE(after.on[i].isApprox(loads.on[1 - i], 1e-12));
    for (int j : {0, 1}) EXPECT_TRUE(after.by[i][j].isApprox(loads.by[1 - i][1 - j], 1e-12));
  }
}

}   // namespace
}   // namespace cablenet::elements
