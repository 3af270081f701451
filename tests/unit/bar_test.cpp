#include "cablenet/elements/bar.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

namespace cablenet::elements {
namespace {

const Bar bar{3e4, 0.5};
const Vector3 start(0.3, -0.2, 0.4), end(0.25, 0.1, 0.38), short_end(0.1, 0.2, -0.15);

/// The central difference errs by h^2 and by eps/h of the forces, some 1e4 N.
constexpr double h = 1e-6, tolerance = 1e-4;

Matrix3 difference(const std::function<Vector3(const Vector3&)>& force, const Vector3& d) {
  Matrix3 K;
  for (int j = 0; j < 3; ++j) {
    const Vector3 step = h * Vector3::Unit(j);
    K.col(j) = (force(d + step) - force(d - step)) / (2 * h);
  }
  return K;
}

double largest(const Matrix3& K) { return K.cwiseAbs().maxCoeff(); }

TEST(Bar, ForceIsAxial) {
  const BarForce pulled = bar_force(bar, Vector3(0, 0, 0.6)), pushed = bar_force(bar, Vector3(0, 0.4, 0));
  EXPECT_LE((pulled.f - Vector3(0, 0, 3000)).norm(), 1e-11);
  EXPECT_LE((pushed.f - Vector3(0, -3000, 0)).norm(), 1e-11);
  EXPECT_EQ(bar_force(bar, Vector3(0.5, 0, 0)).f, Vector3::Zero());
}

TEST(Bar, TangentsAreDerivatives) {
  for (const Vector3& d : {end, short_end}) {
    const auto at_instant = [](const Vector3& at) { return bar_force(bar, at).f; };
    const auto of_step = [](const Vector3& at) { return bar_step_force(bar, start, at).f; };
    EXPECT_LE(largest(bar_force(bar, d).K - difference(at_instant, d)), tolerance);
    EXPECT_LE(largest(bar_step_force(bar, start, d).K - difference(of_step, d)), tolerance);
  }
}

TEST(Bar, ForceIsTheEnergysDerivative) {
  const Vector3 f = bar_force(bar, end).f;
  for (int j = 0; j < 3; ++j) {
    const Vector3 step = h * Vector3::Unit(j);
    EXPECT_NEAR((bar_energy(bar, end + step) - bar_energy(bar, end - step)) / (2 * h), f(j), tolerance);
  }
}

TEST(Bar, StepDoesTheWorkOfTheEnergyAndKeepsAngularMomentum) {
  for (const Vector3& d : {end, short_end, start}) {
    const Vector3 f = bar_step_force(bar, start, d).f;
    // Rounding of products of 1e4 N and 1 m.
    EXPECT_NEAR(f.dot(d - start), bar_energy(bar, d) - bar_energy(bar, start), 1e-11);
    EXPECT_LE(f.cross(start + d).norm(), 1e-11);
  }
  EXPECT_LE((bar_step_force(bar, end, end).f - bar_force(bar, end).f).norm(), 1e-11);
}

TEST(Bar, StaticsStringsAreDerivatives) {
  for (const double exponent : {1.0, 5.0}) {
    const StaticRule rule{StaticRule::Kind::strings, exponent, 700, 0};
    const auto string = [&](const Vector3& d) { return bar_static_force(bar, rule, start, d).f; };
    EXPECT_LE(largest(bar_static_force(bar, rule, start, end).K - difference(string, end)), tolerance);
  }
  const StaticRule linear{StaticRule::Kind::strings, 1, 700, 0};
  EXPECT_LE((bar_static_force(bar, linear, start, end).f - 700 / bar.length * end).norm(), 1e-11);
}

/// The tangent of `ropes` is exact where the chord was the last one, and never has compression in it.
TEST(Bar, StaticsRopesTakeThePredictedTension) {
  const StaticRule ropes{StaticRule::Kind::ropes, 1, 0, 0}, exact{};
  const BarForce pulled = bar_static_force(bar, ropes, start, start), pushed = bar_static_force(bar, ropes, end, end);
  EXPECT_LE(largest(pulled.K - bar_static_force(bar, exact, start, start).K), 1e-10);
  EXPECT_LE((pulled.f - bar_force(bar, start).f).norm(), 1e-11);
  EXPECT_LE((pushed.f - bar_force(bar, end).f).norm(), 1e-11);
  const Vector3 across = end.cross(start).normalized();
  EXPECT_LE((pushed.K * across).norm(), 1e-10);
  EXPECT_LT(across.dot(bar_force(bar, end).K * across), -1e3);
}

}   // namespace
}   // namespace cablenet::elements
