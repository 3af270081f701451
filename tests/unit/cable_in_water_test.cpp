#include <gtest/gtest.h>

#include <functional>

#include "cablenet/elements/cable_in_water_loads.hpp"

namespace cablenet::elements {
namespace {

using environment::Fluid;

const CableInWater rope{4.0, 3.1, 55.0, 2.5, 0.08};
constexpr double L = 1.6, g = 9.81;
const Follow follow{1, 40, 1700};

EndMotion random_motion(double z, double spread = 1) {
  EndMotion m;
  for (int i : {0, 1}) {
    m.x[i] = spread * Vector3::Random() + Vector3(0.3, -0.7, z);
    m.v[i] = Vector3::Random();
    m.a[i] = 3 * Vector3::Random();
  }
  return m;
}

EndMotion moved(EndMotion m, int node, const Vector3& step, const Follow& f) {
  m.x[node] += f.x * step;
  m.v[node] += f.v * step;
  m.a[node] += f.a * step;
  return m;
}

template <class Water>
void expect_exact_tangent(const CableInWater& c, const EndMotion& m, const Water& water, const Follow& f, double h) {
  const EndLoads loads = water_loads<true>(c, L, m, water, f);
  double size = 0;
  for (int i : {0, 1})
    for (int j : {0, 1}) size = std::max(size, loads.by[i][j].norm());
  for (int j : {0, 1})
    for (int k = 0; k < 3; ++k) {
      const auto at = [&](double step) {
        return water_loads<false>(c, L, moved(m, j, step * Vector3::Unit(k), f), water, f);
      };
      // Fourth order.
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

TEST(CableInWater, TangentIsExactInUniformWater) {
  for (int n = 0; n < 20; ++n) {
    expect_exact_tangent(rope, random_motion(0), UniformWater{{0.9, -0.2, 0.3}, g}, follow, 1e-5);
    expect_exact_tangent(rope, random_motion(0), UniformWater{{0.9, -0.2, 0.3}, g}, {1, 0, 0}, 1e-4);
  }
}

TEST(CableInWater, TangentIsExactInWaves) {
  const Fluid fluid = sea();
  for (int n = 0; n < 20; ++n)
    expect_exact_tangent(rope, random_motion(-5), VaryingWater<false>{fluid, 0.7, g}, {1, 3, 11}, 1e-4);
}

TEST(CableInWater, TangentIsExactAcrossTheSurface) {
  const Fluid fluid = sea();
  for (int n = 0; n < 20; ++n)
    expect_exact_tangent(rope, random_motion(0), VaryingWater<true>{fluid, 0.7, g}, {1, 3, 11}, 1e-5);
}

}   // namespace
}   // namespace cablenet::elements
