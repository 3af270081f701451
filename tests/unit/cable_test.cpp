#include "cablenet/elements/cable.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <vector>

namespace {

using namespace cablenet;
using namespace cablenet::elements;

const CableMaterial elastic{1000, 0, 2, 0, false};
const CableMaterial damped{1000, 30, 2, 0.1, false};
const CableMaterial rope{1000, 30, 2, 0, true};
constexpr double L = 1.5;

const Chord taut{{1.2, -0.9, 0.7}, {0.3, 0.5, -0.2}};
const Chord slack{{0.6, 0.5, -0.4}, {0.3, 0.5, -0.2}};

Matrix3 difference(const std::function<Vector3(const Vector3&)>& f, const Vector3& x) {
  const double h = 1e-5;
  Matrix3 slope;
  for (int k = 0; k < 3; ++k) slope.col(k) = (f(x + h * Vector3::Unit(k)) - f(x - h * Vector3::Unit(k))) / (2 * h);
  return slope;
}

TEST(CableForce, TensionIsStiffnessTimesEngineeringStrain) {
  const Chord one_percent{{0, 0, 1.01 * L}, {0, 0, 0}};
  EXPECT_NEAR(cable_tension(elastic, L, one_percent), 10, 1e-10);
  EXPECT_TRUE(cable_force(elastic, L, one_percent).isApprox(Vector3(0, 0, 10), 1e-12));
}

TEST(CableForce, DampingIsTimesStrainRate) {
  const Chord stretching{{0, 0, L}, {5, 0, 0.3}};
  EXPECT_NEAR(cable_tension(damped, L, stretching), 30 * 0.3 / L, 1e-12);
}

TEST(CableForce, SlackRopeCarriesNothingAndBarPushes) {
  EXPECT_EQ(cable_tension(rope, L, slack), 0);
  EXPECT_LT(cable_tension(elastic, L, slack), 0);
  EXPECT_EQ(cable_force_tangent(rope, L, slack, Tangent::exact).d.norm(), 0);
  EXPECT_EQ(cable_strain_energy(rope, L, slack.d), 0);
}

TEST(CableForce, RigidMotionStrainsNothing) {
  const Chord turned{Vector3(1, 2, 2) / 3 * L, Vector3(2, -1, 0)};
  EXPECT_NEAR(cable_tension(damped, L, turned), 0, 1e-12);
}

TEST(CableForce, ExactTangentMatchesDifferences) {
  for (const CableMaterial& material : {elastic, damped, rope})
    for (const Chord& chord : {taut, slack}) {
      const ForceTangent K = cable_force_tangent(material, L, chord, Tangent::exact);
      const Matrix3 d = difference([&](const Vector3& x) { return cable_force(material, L, {x, chord.w}); }, chord.d);
      const Matrix3 w = difference([&](const Vector3& x) { return cable_force(material, L, {chord.d, x}); }, chord.w);
      EXPECT_LT((K.d - d).norm(), 1e-6 * (1 + d.norm()));
      EXPECT_LT((K.w - w).norm(), 1e-6 * (1 + w.norm()));
    }
}

TEST(CableForce, SecantIsThePapersStiffness) {
  const Vector3 e = taut.d.normalized();
  const Matrix3 K = cable_force_tangent(elastic, L, taut, Tangent::secant).d;
  EXPECT_TRUE(K.isApprox(1000 / L * e * e.transpose(), 1e-12));
}

TEST(CableForce, IsTheGradientOfStrainEnergy) {
  for (const Chord& chord : {taut, slack}) {
    const double h = 1e-6;
    Vector3 gradient;
    for (int k = 0; k < 3; ++k)
      gradient(k) = (cable_strain_energy(elastic, L, chord.d + h * Vector3::Unit(k)) -
                     cable_strain_energy(elastic, L, chord.d - h * Vector3::Unit(k))) /
                    (2 * h);
    EXPECT_LT((gradient - cable_force(elastic, L, chord)).norm(), 1e-5);
  }
}

/// Steps between slack and taut chords, in every combination.
std::vector<ChordStep> steps(double xi) {
  const Vector3 a(1.2, -0.9, 0.7), b(1.0, 1.1, -0.6), c(0.6, 0.5, -0.4), d(-0.7, 0.4, 0.3);
  std::vector<ChordStep> all;
  for (const auto& [d0, d1] : {std::pair{a, b}, {a, c}, {c, a}, {c, d}}) all.push_back({d0, d1, 0.02, xi});
  return all;
}

TEST(EnergyMomentum, WorkIsTheChangeOfStrainEnergy) {
  const CableMaterial elastic_rope{1000, 0, 2, 0, true};
  for (const CableMaterial& material : {elastic, elastic_rope})
    for (const ChordStep& step : steps(0)) {
      const double work = energy_momentum_force(material, L, step).dot(step.d1 - step.d0);
      const double change = cable_strain_energy(material, L, step.d1) - cable_strain_energy(material, L, step.d0);
      EXPECT_NEAR(work, change, 1e-11);
    }
}

TEST(EnergyMomentum, DissipationIsOfTheSecondDifference) {
  const double xi = 0.3;
  for (ChordStep step : steps(xi)) {
    const double rise = step.d1.norm() - step.d0.norm();
    step.due = 0.4 * rise + 0.02;
    const double work = energy_momentum_force(elastic, L, step).dot(step.d1 - step.d0);
    const double change = cable_strain_energy(elastic, L, step.d1) - cable_strain_energy(elastic, L, step.d0);
    EXPECT_NEAR(work - change, 1000 / L * xi * (rise - step.due) * rise, 1e-10);
  }
}

/// Of all ropes and steps, whatever the step before: H + xi/2 EA/L (p1 - p0)^2 does not grow.
TEST(EnergyMomentum, WhatStoresAndRemembersNeverGrows) {
  const CableMaterial elastic_rope{1000, 0, 2, 0, true};
  const double xi = 0.2;
  const auto carried = [](const CableMaterial& m, const Vector3& d) {
    return m.tension_only ? std::max(d.norm() - L, 0.0) : d.norm() - L;
  };
  for (const CableMaterial& material : {elastic, damped, rope, elastic_rope})
    for (ChordStep step : steps(xi))
      for (const double due : {-0.5, -0.02, 0.0, 0.03, 0.4}) {
        step.due = due;
        const double work = energy_momentum_force(material, L, step).dot(step.d1 - step.d0);
        const double change = cable_strain_energy(material, L, step.d1) - cable_strain_energy(material, L, step.d0);
        const double grown = carried(material, step.d1) - carried(material, step.d0);
        EXPECT_GE(work - change - 0.5 * xi * 1000 / L * (grown * grown - due * due), -1e-10);
      }
}

TEST(EnergyMomentum, ARopePullsOrIsSilent) {
  const CableMaterial stiff_damper{1000, 3000, 2, 0, true};
  const Vector3 e = Vector3(1, 2, -2) / 3;
  for (const double l1 : {0.9 * L, 1.01 * L, 1.04 * L, 1.2 * L}) {
    const ChordStep step{1.05 * L * e, l1 * e, 0.01, 0.1, 0.3};
    EXPECT_GE(energy_momentum_force(stiff_damper, L, step).dot(e), 0) << "length " << l1;
    EXPECT_GE(cable_tension(stiff_damper, L, {l1 * e, -3 * e}), 0) << "length " << l1;
  }
  const ChordStep closing{1.05 * L * e, 1.01 * L * e, 0.01, 0, 0};
  EXPECT_EQ(energy_momentum_force(stiff_damper, L, closing).norm(), 0);
  EXPECT_EQ(energy_momentum_tangent(stiff_damper, L, closing, Tangent::exact).norm(), 0);
  EXPECT_EQ(cable_force_tangent(stiff_damper, L, {1.01 * L * e, -3 * e}, Tangent::exact).w.norm(), 0);
}

TEST(EnergyMomentum, AngularMomentumIsKept) {
  for (const ChordStep& step : steps(0.1)) {
    const Vector3 middle = 0.5 * (step.d0 + step.d1);
    EXPECT_LT(middle.cross(energy_momentum_force(damped, L, step)).norm(), 1e-11);
  }
}

TEST(EnergyMomentum, ExactTangentMatchesDifferencesInEveryRegime) {
  for (const CableMaterial& material : {elastic, damped, rope})
    for (ChordStep step : steps(0.05)) {
      step.due = 0.1;
      const Matrix3 K = energy_momentum_tangent(material, L, step, Tangent::exact);
      const Matrix3 expected = difference(
          [&](const Vector3& d1) {
            return energy_momentum_force(material, L, {step.d0, d1, step.dt, step.xi, step.due});
          },
          step.d1);
      EXPECT_LT((K - expected).norm(), 1e-6 * (1 + expected.norm()));
    }
}

TEST(EnergyMomentum, ApproachesTheForceForShortSteps) {
  const Vector3 later = taut.d + 1e-6 * taut.w;
  const Vector3 force = energy_momentum_force(damped, L, {taut.d, later, 1e-6, 0});
  EXPECT_LT((force - cable_force(damped, L, taut)).norm(), 1e-3);
}

TEST(CableInertia, IsTheConsistentMass) {
  const EndForces moved = cable_inertia(elastic, L, Vector3(1, 0, 0), Vector3(0, 2, 0));
  EXPECT_TRUE(moved.on1.isApprox(2 * L / 6 * Vector3(2, 2, 0), 1e-14));
  EXPECT_TRUE(moved.on2.isApprox(2 * L / 6 * Vector3(1, 4, 0), 1e-14));
}

TEST(CableInertia, KineticEnergyOfTranslationAndRotation) {
  const Vector3 v(3, -1, 2);
  EXPECT_NEAR(cable_kinetic_energy(elastic, L, v, v), 0.5 * 2 * L * v.squaredNorm(), 1e-12);
  const Vector3 tip(0, 2, 0);
  EXPECT_NEAR(cable_kinetic_energy(elastic, L, Vector3::Zero(), tip), 0.5 * (2 * L * L * L / 3) * (4 / (L * L)), 1e-12);
}

TEST(CableEndForces, HangingElementPullsWithItsWeightAtTheTop) {
  const double g = 9.81;
  const double weight = 2 * L * g;
  const double stretched = L * (1 + 0.5 * weight / 1000);
  const EndForces ends =
      cable_end_forces(elastic, L, g, {{0, 0, -stretched}, Vector3::Zero()}, {Vector3::Zero(), Vector3::Zero()});
  EXPECT_TRUE(ends.on1.isApprox(Vector3(0, 0, weight), 1e-12));
  EXPECT_LT(ends.on2.norm(), 1e-11);
}

}   // namespace
