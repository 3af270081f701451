#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "../support/trajectory.hpp"

using namespace cablenet;
using namespace cablenet::test;
using scene::Scheme;
using solve::Verdict;

namespace {

struct Case {
  const char* name;
  Scheme scheme;
  double radius;
  friend void PrintTo(const Case& item, std::ostream* out) { *out << item.name; }
};

scene::Time time_of(const Case& item, double end, double step) { return {0, end, step, item.scheme, item.radius, 0}; }

const Case energy_momentum{"energy_momentum", Scheme::energy_momentum, 1};
const Case generalized_alpha{"generalized_alpha", Scheme::generalized_alpha, 0.8};

/// A horizontal chain is let go while its top is shaken, so accelerations are not zero at the start.
const std::string shaken = R"(
environment: {gravity: 9.81}
points:
  top: {position: [0, 0, 0], motion: {harmonic: {amplitude: [0, 0.05, 0.1], period: 0.9}}}
  tip: {position: [3, 0, 0], mass: 1, velocity: [0, 2, 0]}
cables: {chain: {type: damped, from: top, to: tip, elements: 3}}
)";

class Dynamics : public testing::TestWithParam<Case> {
protected:
  static Trajectory alone(const Case& item, double step) {
    return Trajectory(shaken, time_of(item, 0.4, step), 0.4, PETSC_COMM_SELF);
  }
};

}   // namespace

TEST_P(Dynamics, PositionsAndVelocitiesAreOfOrderTwo) {
  const Trajectory exact = alone(energy_momentum, 0.4 / 2560);
  std::vector<double> x, v, a;
  for (const int steps : {40, 80, 160}) {
    const Trajectory coarse = alone(GetParam(), 0.4 / steps);
    EXPECT_EQ(coarse.verdict, Verdict::finished);
    EXPECT_EQ(coarse.steps.size(), at(steps));
    x.push_back(size(difference(coarse.x, exact.x)));
    v.push_back(size(difference(coarse.v, exact.v)));
    a.push_back(size(difference(coarse.a, exact.a)));
  }
  for (std::size_t i = 1; i < x.size(); ++i) {
    EXPECT_GE(std::log2(x[i - 1] / x[i]), 1.9) << "positions, error " << x[i];
    EXPECT_GE(std::log2(v[i - 1] / v[i]), 1.9) << "velocities, error " << v[i];
    EXPECT_GE(std::log2(a[i - 1] / a[i]), 0.8) << "accelerations, error " << a[i];
  }
}

TEST_P(Dynamics, AllNumbersOfRanksAgree) {
  const Trajectory one = alone(GetParam(), 0.02);
  const Trajectory all(shaken, time_of(GetParam(), 0.4, 0.02), 0.4, PETSC_COMM_WORLD);
  EXPECT_LE(size(difference(one.x, all.x)), 1e-10 * size(one.x));
  EXPECT_LE(size(difference(one.v, all.v)), 1e-10 * size(one.v));
  EXPECT_LE(size(difference(one.a, all.a)), 1e-9 * size(one.a));
  EXPECT_NEAR(one.energies.back(), all.energies.back(), 1e-10 * std::abs(one.energies.back()));
}

INSTANTIATE_TEST_SUITE_P(Schemes, Dynamics,
                         testing::Values(energy_momentum, generalized_alpha,
                                         Case{"generalized_alpha_0", Scheme::generalized_alpha, 0},
                                         Case{"plain", Scheme::plain, 0.8}, Case{"plain_1", Scheme::plain, 1}),
                         [](const auto& item) { return item.param.name; });

TEST(DynamicsRun, TheFirstAccelerationIsExact) {
  const std::string falling = R"(
environment: {gravity: 9.81}
points: {a: {position: [0, 0, 0], mass: 1, force: [3, 0, 0]}, b: {position: [3, 0, 0], velocity: [0, 0, 1]}}
cables: {chain: {type: rope, from: a, to: b, elements: 3, length: 6}}
)";
  const Trajectory slow(falling, time_of(energy_momentum, 1e-3, 1e-3), 0, PETSC_COMM_WORLD);
  EXPECT_EQ(slow.outputs.size(), 2u);
  // Whatever the cable does, mass times acceleration sums up to the weight and the constant force.
  Vector3 push = slow.a[SceneNode(0)];
  for (SceneNode node(0); node.value() < slow.a.size(); ++node) {
    const double mass = 0.5 * 2 * (node.value() < 2 ? 0.5 : 1);
    push += mass * slow.a[node];
  }
  EXPECT_LE((push - Vector3(3, 0, -9.81 * 4)).norm(), 1e-8);
}

namespace {

/// The range of the total energy of a chain whose top has the given motion.
double imbalance(const std::string& motion, double step) {
  const std::string undamped = R"(
environment: {gravity: 9.81}
points:
  top: {position: [0, 0, 0], mass: 2, motion: )" +
                               motion + R"(}
  tip: {position: [3, 0, 0], mass: 1, velocity: [0, 2, 0], force: [1, 2, 3]}
cables: {chain: {type: rope, from: top, to: tip, elements: 3}}
)";
  const Trajectory run(undamped, time_of(energy_momentum, 1.2, step), 0, PETSC_COMM_WORLD);
  EXPECT_EQ(run.verdict, Verdict::finished);
  const auto [least, most] = std::minmax_element(run.energies.begin(), run.energies.end());
  return *most - *least;
}

}   // namespace

TEST(DynamicsRun, EnergyMomentumBalancesTheWorkOfMovedPoints) {
  EXPECT_LE(imbalance("{velocity: [0.3, 2, 0.5]}", 0.03), 1e-8);
  const std::string shaking = "{harmonic: {amplitude: [0.3, 0.2, 0.5], period: 0.7}}";
  const double coarse = imbalance(shaking, 0.03), fine = imbalance(shaking, 0.015);
  EXPECT_LE(fine, 0.3 * coarse);
  EXPECT_LE(coarse, 0.3);
}

/// Newton's method gets too few iterations for the large step.
TEST_P(Dynamics, ARetriedStepGoesOnAndGrowsBack) {
  const Option few("-snes_max_it", "3");
  const Option tight("-snes_atol", "1e-9");
  const scene::Time time{0, 1.6, 0.2, GetParam().scheme, GetParam().radius, 0};
  Trajectory run(shaken, time, 0.4, PETSC_COMM_WORLD);
  EXPECT_EQ(run.verdict, Verdict::finished);
  EXPECT_GT(run.counts().rejected, 0);
  EXPECT_EQ(run.counts().steps, static_cast<long>(run.steps.size()));
  EXPECT_EQ(run.outputs, (std::vector<double>{0, 0.4, 0.8, 0.4 * 3, 1.6}));
  ASSERT_FALSE(run.steps.empty());
  EXPECT_LT(run.steps.front(), 0.11);
  const Trajectory exact(shaken, time_of(energy_momentum, 1.6, 1e-3), 1.6, PETSC_COMM_SELF);
  EXPECT_LE(size(difference(run.x, exact.x)), 0.5) << "retried steps lead astray";
}

namespace {

/// The element ab is as long as point a moves in the first step, so that its two ends meet exactly at the step's end.
const std::string meeting = R"(
points:
  a: {position: [0, 0, 0], motion: {velocity: [1, 0, 0]}}
  b: {position: [1, 0, 0], motion: fixed}
  c: {position: [3, 0, 0], mass: 1}
cables:
  bc: {type: slack, from: b, to: c, elements: 3}
  ab: {type: slack, from: a, to: b, elements: 1}
)";

const scene::Time long_steps = time_of(energy_momentum, 12, 1);

}   // namespace

TEST(DynamicsRun, AStepOutsideTheDomainOfOneRankIsRetriedByAll) {
  const Option scale("-ts_adapt_scale_solve_failed", "0.3");
  Trajectory run(meeting, long_steps, 12, PETSC_COMM_WORLD);
  EXPECT_EQ(run.verdict, Verdict::finished);
  EXPECT_GT(run.counts().rejected, 0);
  ASSERT_GE(run.steps.size(), 10u);
  EXPECT_NEAR(run.steps.front(), 0.3, 1e-12);
  EXPECT_GT(*std::max_element(run.steps.begin(), run.steps.end()), 0.9);
  EXPECT_EQ(run.outputs, (std::vector<double>{0, 12}));
}

TEST(DynamicsRun, WhereItCannotGoOnItNamesTheElement) {
  const Option never("-ts_max_reject", "0");
  Trajectory run(meeting, long_steps, 12, PETSC_COMM_WORLD);
  EXPECT_EQ(run.verdict, Verdict::failed);
  EXPECT_EQ(run.dynamics().failed_part().element, 3);
  EXPECT_EQ(run.network().element_name(3), "ab, element 1 of 1");
  EXPECT_NE(run.dynamics().failure().find("DIVERGED"), std::string::npos) << run.dynamics().failure();
  EXPECT_TRUE(run.steps.empty());
  EXPECT_EQ(run.x[SceneNode(2)], Vector3(3, 0, 0));
}

TEST(DynamicsRun, AFailureLeavesTheLastGoodState) {
  Trajectory good(shaken, time_of(generalized_alpha, 0.1, 0.1), 0.1, PETSC_COMM_WORLD);
  const Option never("-ts_max_reject", "0");
  const Option few("-snes_max_it", "2");
  const Option unreachable("-snes_atol", "1e-30");
  Trajectory run(shaken, time_of(generalized_alpha, 0.4, 0.1), 0.4, PETSC_COMM_WORLD);
  EXPECT_EQ(run.verdict, Verdict::failed);
  const int element = run.dynamics().failed_part().element;
  EXPECT_GE(element, 0);
  EXPECT_LT(element, 3);
  EXPECT_NE(run.dynamics().failure().find("DIVERGED"), std::string::npos) << run.dynamics().failure();
  EXPECT_EQ(run.outputs.size(), run.steps.empty() ? 1u : 2u);
}

TEST(DynamicsRun, MaxStepsAndMaxTimeStopIt) {
  {
    const Option three("-ts_max_steps", "3");
    const Trajectory run(shaken, time_of(energy_momentum, 0.4, 0.02), 0.2, PETSC_COMM_WORLD);
    EXPECT_EQ(run.verdict, Verdict::stopped);
    EXPECT_EQ(run.counts().steps, 3);
    ASSERT_EQ(run.outputs.size(), 2u);
    EXPECT_DOUBLE_EQ(run.outputs.back(), 0.06);
  }
  const Option early("-ts_max_time", "0.1");
  const Trajectory run(shaken, time_of(energy_momentum, 0.4, 0.02), 0.04, PETSC_COMM_WORLD);
  EXPECT_EQ(run.verdict, Verdict::stopped);
  EXPECT_EQ(run.outputs, (std::vector<double>{0, 0.04, 0.08, 0.1}));
}
