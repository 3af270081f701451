#include <algorithm>
#include <cmath>
#include <numeric>

#include "../support/trajectory.hpp"
#include "cablenet/solve/scheme.hpp"
#include "cablenet/solve/step_control.hpp"

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

scene::Time time_of(const Case& item, double end, double step, std::optional<double> tolerance) {
  return {0, end, step, item.scheme, item.radius, 0, tolerance};
}

const Case energy_momentum{"energy_momentum", Scheme::energy_momentum, 1};

/// The motion of this chain is smooth: nothing happens suddenly.
const std::string swinging = R"(
environment: {gravity: 9.81}
points:
  top: {position: [0, 0, 0], motion: {harmonic: {amplitude: [0, 0.05, 0.1], period: 0.9}}}
  tip: {position: [3, 0, 0], mass: 1, velocity: [0, 2, 0]}
cables: {chain: {type: damped, from: top, to: tip, elements: 3}}
)";

/// The mass falls 0.5 m until the rope is taut, 0.319 s after the start.  Then it is thrown up again.
const std::string snapping = R"(
environment: {gravity: 9.81}
points:
  top: {position: [0, 0, 0], motion: fixed}
  tip: {position: [0, 0, -0.5], mass: 1}
cables: {rope: {type: slack, from: top, to: tip, elements: 1, length: 1}}
)";

/// A body that tumbles, at the end of a rope.  Its reach is 1 m.
std::string tumbling(const char* rotation) {
  return std::string(R"(
environment: {gravity: 9.81}
points: {top: {position: [0, 0, 4], motion: fixed}}
bodies:
  top_heavy:
    {mass: 20, inertia: [4, 9, 11], position: [0, 0, 0], angular_velocity: [3, -2, 4], torque: [5, 0, -6],
     attachments: {eye: [0, 0.6, 0.8]}, rotation: )") +
         rotation + R"(}
cables: {rope: {type: rope, from: top, to: top_heavy.eye, elements: 1}}
)";
}

double turn_between(const Trajectory& one, const Trajectory& other) {
  return one.bodies[0].attitude.angularDistance(other.bodies[0].attitude);
}

class Adaptive : public testing::TestWithParam<Case> {
protected:
  static Trajectory run(const std::string& text, double end, double step, std::optional<double> tolerance,
                        double interval, MPI_Comm communicator = PETSC_COMM_WORLD) {
    return Trajectory(text, time_of(GetParam(), end, step, tolerance), interval, communicator);
  }
};

}   // namespace

TEST_P(Adaptive, AStepIsRejectedForMoreThanItsError) {
  const double step = 0.01;
  const Trajectory exact(swinging, time_of(energy_momentum, step, step / 64, {}), step, PETSC_COMM_SELF);
  const Trajectory once = run(swinging, step, step, {}, step);
  double error = 0;
  for (const Vector3& apart : difference(once.x, exact.x)) error = std::max(error, apart.norm());
  EXPECT_EQ(run(swinging, step, step, 2 * error, step).counts().rejected, 0);
  EXPECT_GT(run(swinging, step, step, error / 2, step).counts().rejected, 0);
}

/// The step's error in attitude is larger than that in position.  At both steps the estimate is right within a factor
/// of two, so that it follows the step's third power as the error does.
TEST_P(Adaptive, ABodysStepIsRejectedForMoreThanTheErrorOfItsTurn) {
  for (const char* rotation : {"quaternion", "euler"}) {
    std::vector<double> errors;
    for (const double step : {0.01, 0.005}) {
      const std::string text = tumbling(rotation);
      const Trajectory exact(text, time_of(energy_momentum, step, step / 64, {}), step, PETSC_COMM_SELF);
      const Trajectory once = run(text, step, step, {}, step, PETSC_COMM_SELF);
      const double error = turn_between(once, exact);
      EXPECT_GT(error, 2 * (once.x[SceneNode(1)] - exact.x[SceneNode(1)]).norm()) << rotation;
      EXPECT_EQ(run(text, step, step, 2 * error, step).counts().rejected, 0) << rotation << ' ' << step;
      EXPECT_GT(run(text, step, step, error / 2, step).counts().rejected, 0) << rotation << ' ' << step;
      errors.push_back(error);
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), 3, 0.5) << rotation;
  }
}

TEST_P(Adaptive, ErrorsOfTurnsFollowTheTolerance) {
  for (const char* rotation : {"quaternion", "euler"}) {
    const std::string text = tumbling(rotation);
    const Trajectory exact(text, time_of(energy_momentum, 0.3, 1e-4, {}), 0.3, PETSC_COMM_SELF);
    std::vector<double> errors;
    for (const double tolerance : {64e-6, 1e-6})
      errors.push_back(turn_between(run(text, 0.3, 0.01, tolerance, 0.3, PETSC_COMM_SELF), exact));
    EXPECT_GE(errors[0] / errors[1], 64 / 4) << rotation;
    EXPECT_LE(errors[0] / errors[1], 64 * 4) << rotation;
  }
}

TEST_P(Adaptive, ErrorsFollowTheTolerance) {
  const Trajectory exact(swinging, time_of(energy_momentum, 1, 1e-4, {}), 1, PETSC_COMM_SELF);
  std::vector<double> errors;
  for (const double tolerance : {64e-6, 1e-6, 1e-6 / 64}) {
    const Trajectory coarse = run(swinging, 1, 0.01, tolerance, 1);
    EXPECT_EQ(coarse.verdict, Verdict::finished);
    errors.push_back(size(difference(coarse.x, exact.x)));
  }
  // The error is proportional to the step's square, and so is what is held below the tolerance.  Steps are halved and
  // doubled, so that each of two errors may be four times smaller than it needs to be.
  for (std::size_t i = 1; i < errors.size(); ++i) {
    EXPECT_GE(errors[i - 1] / errors[i], 64 / 4) << "errors " << errors[i - 1] << " and " << errors[i];
    EXPECT_LE(errors[i - 1] / errors[i], 64 * 4) << "errors " << errors[i - 1] << " and " << errors[i];
  }
}

TEST_P(Adaptive, StepsShrinkInASnapAndGrowBack) {
  const Trajectory fall = run(snapping, 1, 0.02, 1e-5, 0.1);
  EXPECT_EQ(fall.verdict, Verdict::finished);
  EXPECT_GT(fall.counts().rejected, 0);
  const auto shortest = std::min_element(fall.steps.begin(), fall.steps.end());
  const double when = std::accumulate(fall.steps.begin(), shortest, 0.0);
  EXPECT_GT(when, 0.3);
  EXPECT_LT(when, 0.5);
  const double before = *std::max_element(fall.steps.begin(), shortest);
  const double after = *std::max_element(shortest, fall.steps.end());
  EXPECT_GT(before, 8 * *shortest);
  EXPECT_GE(after, (1 - 1e-12) * before);   // times are rounded
}

TEST_P(Adaptive, OutputsAreMetExactly) {
  const Trajectory fall = run(snapping, 1, 0.02, 1e-5, 0.3);
  EXPECT_EQ(fall.outputs, (std::vector<double>{0, 0.3, 2 * 0.3, 3 * 0.3, 1}));
}

TEST_P(Adaptive, AllNumbersOfRanksTakeTheSameSteps) {
  for (const std::string& text : {swinging, tumbling("quaternion")}) {
    const Trajectory one = run(text, 0.5, 0.01, 1e-5, 0.25, PETSC_COMM_SELF), all = run(text, 0.5, 0.01, 1e-5, 0.25);
    EXPECT_EQ(one.counts().rejected, all.counts().rejected);
    ASSERT_EQ(one.steps.size(), all.steps.size());
    for (std::size_t i = 0; i < one.steps.size(); ++i) EXPECT_NEAR(one.steps[i], all.steps[i], 1e-12);
    EXPECT_LE(size(difference(one.x, all.x)), 1e-9 * size(one.x));
  }
}

TEST_P(Adaptive, RejectedStepsLeaveNoTrace) {
  const Trajectory retried = run(swinging, 0.02, 0.02, 1e-6, 0);
  ASSERT_FALSE(retried.steps.empty());
  EXPECT_GT(retried.counts().rejected, 0);
  const Trajectory direct = run(swinging, 0.02, retried.steps.front(), 1e-6, 0);
  EXPECT_EQ(direct.counts().rejected, 0);
  EXPECT_LE(size(difference(retried.x, direct.x)), 1e-12);
  EXPECT_LE(size(difference(retried.v, direct.v)), 1e-10);
}

TEST_P(Adaptive, FailuresOfNewtonShortenStepsAsWell) {
  const Option few("-snes_max_it", "3");
  const Option tight("-snes_atol", "1e-9");
  const Trajectory shaken = run(swinging, 1.6, 0.2, 1, 0.4);
  EXPECT_EQ(shaken.verdict, Verdict::finished);
  EXPECT_GT(shaken.counts().rejected, 0);
  EXPECT_EQ(shaken.outputs, (std::vector<double>{0, 0.4, 0.8, 0.4 * 3, 1.6}));
}

TEST_P(Adaptive, AToleranceOutOfReachIsToldOf) {
  Trajectory stuck = run(swinging, 1, 0.01, 1e-30, 0.5);
  EXPECT_EQ(stuck.verdict, Verdict::failed);
  EXPECT_NE(stuck.dynamics().failure().find("tolerance"), std::string::npos) << stuck.dynamics().failure();
  const Option never("-ts_max_reject", "0");
  Trajectory refused = run(swinging, 1, 0.01, 1e-9, 0.5);
  EXPECT_EQ(refused.verdict, Verdict::failed);
  EXPECT_TRUE(refused.steps.empty());
  EXPECT_NE(refused.dynamics().failure().find("tolerance"), std::string::npos) << refused.dynamics().failure();
}

TEST_P(Adaptive, PetscsOptionsWin) {
  const Option fixed("-ts_adapt_type", "none");
  const Trajectory coarse = run(swinging, 1, 0.1, 1e-9, 0.5);
  EXPECT_EQ(coarse.counts().steps, 10);
}

INSTANTIATE_TEST_SUITE_P(Schemes, Adaptive,
                         testing::Values(energy_momentum, Case{"generalized_alpha", Scheme::generalized_alpha, 0.8},
                                         Case{"generalized_alpha_0", Scheme::generalized_alpha, 0}),
                         [](const auto& item) { return item.param.name; });

namespace {

/// x'' = -x by the generalised-alpha method.  The force is taken at the stage: for x'' = -x TSALPHA2 does the same.
class Oscillator {
public:
  explicit Oscillator(const solve::AlphaWeights& weights) : alpha_{weights, 0} {}

  void step(double dt) {
    alpha_.dt = dt;
    const double am = alpha_.alpha_m, af = alpha_.alpha_f, gamma = alpha_.gamma, beta = alpha_.beta;
    start_x = x, start_v = v, start_kept = kept, start_growth = growth;
    const double guess = x + dt * v + dt * dt * (0.5 - beta) * a_;
    const double next = -((1 - am) * a_ + (1 - af) * x + af * guess) / (am + af * beta * dt * dt);
    x = guess + beta * dt * dt * next;
    v += dt * ((1 - gamma) * a_ + gamma * next);
    a_ = next;
    kept = alpha_.is_centred() ? (v - start_v) / dt : next;
    if (alpha_.is_centred()) growth = {kept - start_kept, 0, 0};
  }
  /// The error of the last step against the exact solution from the step's start.
  double true_error() const { return std::abs(x - start_x * std::cos(alpha_.dt) - start_v * std::sin(alpha_.dt)); }
  const solve::AlphaStep& alpha() const { return alpha_; }

  double x = 0.6, v = 0.8, kept = -0.6;
  double start_x = 0, start_v = 0, start_kept = 0;
  std::vector<double> growth, start_growth;   ///< of what is kept, of the unknowns of a node

private:
  solve::AlphaStep alpha_;
  double a_ = -0.6;
};

/// A vector of one node, with `value` in the first component and 0 in the others.
system::Vector vector_of(double value) {
  system::Vector vector;
  petsc::check(VecCreateSeq(PETSC_COMM_SELF, 3, vector.out()));
  petsc::check(VecSetValue(vector, 0, value, INSERT_VALUES));
  petsc::check(VecAssemblyBegin(vector));
  petsc::check(VecAssemblyEnd(vector));
  return vector;
}

}   // namespace

TEST(LocalError, TheEstimateIsTheTrueOne) {
  partition::LocalNetwork one_node;
  one_node.owned = 1;
  one_node.begin.push_back(Unknown(0));
  one_node.begin.push_back(Unknown(3));
  for (const Case& item :
       {energy_momentum, Case{"damped", Scheme::energy_momentum, 0.5}, Case{"1", Scheme::plain, 1},
        Case{"0.8", Scheme::plain, 0.8}, Case{"0.3", Scheme::plain, 0.3}, Case{"0", Scheme::plain, 0}}) {
    Oscillator oscillator(solve::weights_of(time_of(item, 1, 1, {})));
    solve::LocalError local_error;
    int count = 0;
    for (const double dt : {8, 8, 8, 8, 8, 4, 4, 4, 2, 1, 1, 1, 2, 4, 4, 4, 8, 8, 8, 7, 7, 7, 8, 8}) {
      oscillator.step(1e-3 * dt);
      const system::Vector x = vector_of(oscillator.start_x), v = vector_of(oscillator.start_v),
                           a = vector_of(oscillator.start_kept), end = vector_of(oscillator.x);
      const double error =
          local_error.estimate(oscillator.alpha(), one_node, {x, v, a, a}, oscillator.start_growth, end);
      local_error.accept(oscillator.alpha());
      EXPECT_GT(error, 0.5 * oscillator.true_error()) << item.name << ", step " << count;
      EXPECT_LT(error, 2 * oscillator.true_error()) << item.name << ", step " << count;
      ++count;
    }
  }
}

namespace {

struct OfSteps {
  double alternation;   ///< of v, from step to step [m/s]
  double jerk;          ///< x''' of the motion beside [m/s^3]
};

/// The estimate for the last of steps of these lengths, by which a node moves as is told.  Means are kept.
double estimated(const std::vector<double>& lengths, const OfSteps& motion) {
  const solve::AlphaWeights centred = solve::weights_of(time_of(energy_momentum, 1, 1, {}));
  partition::LocalNetwork one_node;
  one_node.owned = 1;
  one_node.begin.push_back(Unknown(0));
  one_node.begin.push_back(Unknown(3));
  solve::LocalError local_error;
  double t = 0, x = 0, kept = 0, result = 0, sign = 1;
  std::vector<double> growth;
  const auto velocity = [&](double at) { return motion.jerk * at * at / 2 + sign * motion.alternation; };
  for (const double dt : lengths) {
    const double v = velocity(t);
    sign = -sign;
    const double next_v = velocity(t + dt), next_x = x + dt * (v + next_v) / 2;
    const system::Vector at_x = vector_of(x), at_v = vector_of(v), at_a = vector_of(kept), end = vector_of(next_x);
    result = local_error.estimate({centred, dt}, one_node, {at_x, at_v, at_a, at_a}, growth, end);
    local_error.accept({centred, dt});
    const double mean = (next_v - v) / dt;
    growth = {mean - kept, 0, 0};
    kept = mean, x = next_x, t += dt;
  }
  return result;
}

}   // namespace

/// Motion that is too fast for the steps alternates in v.  It leaves nothing astray where steps grow, either.
TEST(LocalError, WhatAlternatesDoesNotCount) {
  for (const auto& lengths :
       {std::vector<double>{1, 1, 1, 1}, std::vector<double>{1, 1, 1, 2}, std::vector<double>{1, 1, 2, 2},
        std::vector<double>{1, 2, 2, 2}, std::vector<double>{4, 4, 4, 3}}) {
    const double plain = estimated(lengths, {0, 1}), dt = lengths.back();
    EXPECT_NEAR(plain, dt * dt * dt / 12, 0.5 * dt * dt * dt / 12);
    EXPECT_NEAR(estimated(lengths, {1, 1}), plain, 1e-12);
  }
}

/// What the step before could not see may all have happened in a shorter one.
TEST(LocalError, AShortStepIsEstimatedByItself) {
  const double long_ago = estimated({16, 16, 16, 1}, {0, 1});
  EXPECT_GE(long_ago, 8.0 / 12);
  EXPECT_GE(estimated({16, 16, 1, 1}, {0, 1}), 8.0 / 12);
}

namespace {

/// The limit after the given number of equal steps that err alike.
double limit_after(int steps, double error, double dt, double longest) {
  solve::StepControl control(1, dt, longest, 1e-10, 3);
  for (int i = 0; i < steps; ++i) {
    EXPECT_TRUE(control.accepts(error, dt));
    control.advance(false);
  }
  return control.limit();
}

}   // namespace

TEST(StepControl, GrowsAsFarAsTheErrorAllows) {
  EXPECT_EQ(limit_after(1, 1e-9, 1, 16), 1);
  EXPECT_EQ(limit_after(2, 1e-9, 1, 16), 4);
  EXPECT_EQ(limit_after(2, 0.7 / 64 * 1.01, 1, 16), 2);
  EXPECT_EQ(limit_after(2, 0.7 / 8 * 0.99, 1, 16), 2);
  EXPECT_EQ(limit_after(2, 0.7 / 8 * 1.01, 1, 16), 1);
}

/// Where it is a small part, any number of steps will do.
TEST(StepControl, GrowsToAHalfOrAQuarterOfTheLongestStep) {
  EXPECT_EQ(limit_after(2, 1e-9, 1, 20), 2.5);
  EXPECT_EQ(limit_after(2, 1e-9, 1, 100), 4);
  EXPECT_EQ(limit_after(2, 0.05, 1.25, 20), 2.5);
  EXPECT_EQ(limit_after(2, 0.05, 2, 20), 2.5);
  EXPECT_EQ(limit_after(2, 1e-9, 8, 20), 20);
  EXPECT_EQ(limit_after(9, 1e-9, 20, 20), 20);
}

namespace {

/// The cable of examples/free_fall.
network::Network whip() {
  return network::build_network(scene::read_scene(R"(
environment: {gravity: 9.81}
cable_types: {steel: {area: 1.962e-5, density: 7800, youngs_modulus: 53e9}}
points: {pin: {position: [0, 0, 0], motion: fixed}, free: {position: [1.713, 0, 0]}}
cables: {cable: {type: steel, from: pin, to: free, length: 1.713, elements: 24}}
time: {end: 1, step: 1.0e-3}
)",
                                                  "whip.yaml"));
}

struct Fall {
  long attempts;
  double error;   ///< of the free end after 1 s [m]
};

Fall fall(Scheme scheme, double radius, std::optional<double> tolerance) {
  const network::Network network = whip();
  const scene::Time time{0, 1, 1e-3, scheme, radius, 0.05, tolerance};
  const Trajectory run(network, time, 0.1, PETSC_COMM_WORLD);
  // The exact place is from examples/free_fall/reference.csv.
  const Vector3 exact(-1.56354970013115, 0, -0.616180665274549);
  return {run.counts().steps + run.counts().rejected, (run.x[SceneNode(1)] - exact).norm()};
}

void expect_fewer_steps(Scheme scheme, double radius, double tolerance) {
  const Fall fixed = fall(scheme, radius, {}), adaptive = fall(scheme, radius, tolerance);
  EXPECT_LE(adaptive.error, fixed.error);
  EXPECT_LE(adaptive.attempts, 0.9 * static_cast<double>(fixed.attempts));
}

}   // namespace

TEST(AdaptiveWhip, TakesFewerStepsThanAFixedStep) {
  expect_fewer_steps(Scheme::energy_momentum, 1, 1.2e-4);
  expect_fewer_steps(Scheme::energy_momentum, 0.9, 1.2e-4);
}

/// Undamped vibration of the rod, of at most 7 ms, moves nodes by 2e-6 m at most.  The turn by 1 rad/s counts over
/// 1 s, a tenth of the run.  It wants steps of sqrt(12 tolerance) = 35 ms, of sqrt(12 tolerance/3) = 20 ms where
/// vibration adds to x''', and gets 16 ms: 625 of them.
TEST(AdaptiveVibration, WhatIsTooFastForTheStepDoesNotKeepItShort) {
  const std::string struck = R"(
environment: {gravity: 0}
cable_types: {rod: {mass_per_length: 1, axial_stiffness: 1e6}}
points:
  pin: {position: [0, 0, 0], motion: fixed}
  end: {position: [1, 0, 0], velocity: [0.002, 1, 0], mass: 1}
cables: {rod: {type: rod, from: pin, to: end, elements: 4}}
time: {end: 10, step: 1.0e-3}
)";
  const network::Network network = network::build_network(scene::read_scene(struck, "struck.yaml"));
  const scene::Time time{0, 10, 1e-3, Scheme::energy_momentum, 1, 0, 1e-4};
  const Trajectory run(network, time, 10, PETSC_COMM_WORLD);
  EXPECT_EQ(run.verdict, Verdict::finished);
  EXPECT_LE(run.counts().steps, 700);
}
