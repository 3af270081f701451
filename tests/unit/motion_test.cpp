#include "cablenet/scene/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cablenet/base/errors.hpp"

namespace cablenet::scene {
namespace {

/// v and a agree with the first and second differences of x, to the error of the differences.
void expect_consistent(const Motion& motion, double t) {
  const double h = 1e-4;
  const Kinematics before = motion.at(t - h), here = motion.at(t), after = motion.at(t + h);
  const Vector3 v = (after.x - before.x) / (2 * h);
  const Vector3 a = (after.v - before.v) / (2 * h);
  EXPECT_LT((here.v - v).norm(), 1e-6 * (1 + here.v.norm())) << "t = " << t;
  EXPECT_LT((here.a - a).norm(), 1e-6 * (1 + here.a.norm())) << "t = " << t;
}

Motion written(const std::string& x) { return Motion::expression(Vector3::Zero(), {x, "0", "0"}); }

std::string refusal(const std::string& text) {
  try {
    written(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_refused(const std::string& text, const std::string& reason) {
  const std::string message = refusal(text);
  EXPECT_NE(message.find("\"" + text + "\" is not allowed"), std::string::npos) << message;
  EXPECT_NE(message.find(reason), std::string::npos) << message;
  EXPECT_NE(message.find("expected an expression of t"), std::string::npos) << message;
}

TEST(Motion, FixedStays) {
  const Kinematics k = Motion::fixed({1, 2, 3}).at(17);
  EXPECT_EQ(k.x, Vector3(1, 2, 3));
  EXPECT_EQ(k.v, Vector3(0, 0, 0));
  EXPECT_EQ(k.a, Vector3(0, 0, 0));
}

TEST(Motion, UniformIsAtItsPositionAtItsStart) {
  const Motion motion = Motion::uniform({1, 2, 3}, {4, 0, -2}, 0.5);
  EXPECT_EQ(motion.at(0.5).x, Vector3(1, 2, 3));
  EXPECT_EQ(motion.at(1.5).x, Vector3(5, 2, 1));
  expect_consistent(motion, 1.1);
}

TEST(Motion, HarmonicFollowsItsFormula) {
  const Motion motion = Motion::harmonic({1, 0, 0}, {0, 2, 1}, 4, std::numbers::pi / 2);
  EXPECT_NEAR(motion.at(0).x[1], 2, 1e-15);
  EXPECT_NEAR(motion.at(1).x[1], 0, 1e-15);
  for (double t : {0.0, 0.3, 1.7, 9.9}) expect_consistent(motion, t);
}

TEST(Motion, WaypointsAreHitAndSmooth) {
  const std::vector<double> times{0, 1, 2.5, 4};
  const std::vector<Vector3> places{{0, 0, 0}, {1, 2, 0}, {0, 3, -1}, {5, 3, 2}};
  const Motion motion = Motion::waypoints(times, places);
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_LT((motion.at(times[i]).x - places[i]).norm(), 1e-14);
  for (double t : {0.2, 0.9, 1.5, 3.3}) expect_consistent(motion, t);
  EXPECT_EQ(motion.first_time(), 0);
  EXPECT_EQ(motion.last_time(), 4);
}

TEST(Motion, WaypointsAreTwiceContinuousAtAWaypointAndNaturalAtTheEnds) {
  const Motion motion = Motion::waypoints({0, 1, 2.5, 4}, {{0, 0, 0}, {1, 2, 0}, {0, 3, -1}, {5, 3, 2}});
  const double e = 1e-9;
  for (double t : {1.0, 2.5}) {
    const Kinematics left = motion.at(t - e), right = motion.at(t + e);
    EXPECT_LT((left.v - right.v).norm(), 1e-6);
    EXPECT_LT((left.a - right.a).norm(), 1e-6);
    EXPECT_GT(left.a.norm(), 0.1);
  }
  EXPECT_LT(motion.at(0).a.norm(), 1e-14);
  EXPECT_LT(motion.at(4).a.norm(), 1e-13);
}

TEST(Motion, TwoWaypointsAreALine) {
  const Motion motion = Motion::waypoints({1, 3}, {{0, 0, 0}, {4, 2, 0}});
  EXPECT_LT((motion.at(2).x - Vector3(2, 1, 0)).norm(), 1e-15);
  EXPECT_LT((motion.at(2).v - Vector3(2, 1, 0)).norm(), 1e-15);
  EXPECT_EQ(motion.at(2).a, Vector3(0, 0, 0));
}

TEST(Motion, WaypointsBearARoundingErrorPastTheEnd) {
  const Motion motion = Motion::waypoints({0, 1, 2}, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  EXPECT_NEAR(motion.at(2 + 1e-15).x[0], 2, 1e-14);
}

TEST(Motion, ExpressionDerivativesAreExact) {
  const Motion motion = Motion::expression({1, 2, 3}, {"10*sin(0.5*t)", "t^3/6 - 2*t", "exp(-t^2)"});
  const double t = 1.3;
  const Kinematics k = motion.at(t);
  EXPECT_DOUBLE_EQ(k.x[0], 1 + 10 * std::sin(0.5 * t));
  EXPECT_DOUBLE_EQ(k.v[0], 5 * std::cos(0.5 * t));
  EXPECT_DOUBLE_EQ(k.a[0], -2.5 * std::sin(0.5 * t));
  EXPECT_DOUBLE_EQ(k.v[1], t * t / 2 - 2);
  EXPECT_DOUBLE_EQ(k.a[1], t);
  EXPECT_NEAR(k.a[2], (4 * t * t - 2) * std::exp(-t * t), 1e-15);
}

/// GiNaC sorts operands anew for each object, and by addresses in memory.  Ranks and runs must round alike.
TEST(Motion, AnExpressionRoundsAlikeEachTime) {
  const char* text =
      "0.2*sin(2*pi*t/1.25)*(1 - step(3.75 - t)*(1 - (t/3.75)^3*(10 - 15*(t/3.75) + 6*(t/3.75)^2))) + exp(-t)/(1 + t)";
  const Kinematics first = written(text).at(1.3);
  for (int i = 0; i < 50; ++i) {
    const Kinematics again = written(text).at(1.3);
    EXPECT_EQ(again.x[0], first.x[0]);
    EXPECT_EQ(again.v[0], first.v[0]);
    EXPECT_EQ(again.a[0], first.a[0]);
  }
}

TEST(Motion, EveryFunctionOfAnExpressionIsConsistent) {
  for (const char* text : {"sin(t)",
                           "cos(2*t)",
                           "tan(t/2)",
                           "asin(t/5)",
                           "acos(t/5)",
                           "atan(t)",
                           "sinh(t)",
                           "cosh(t)",
                           "tanh(t)",
                           "exp(t)",
                           "log(t)",
                           "sqrt(t)",
                           "t^2.5",
                           "t^t",
                           "2^t",
                           "1/(1+t)",
                           "pi*t^2",
                           "1.0e-3*t^2",
                           ".5*t",
                           "-t^2",
                           "2^(-t)",
                           "step(t-0.5)*(t-0.5)^3",
                           "1/3*t^7",
                           "(1+t)^(-2/3)",
                           "sin(cos(t))^2*t",
                           "(2^t)^2 + t^2*t^3 - 2^(t^2)/3^t"}) {
    SCOPED_TRACE(text);
    const Motion motion = written(text);
    for (double t : {0.7, 1.3}) expect_consistent(motion, t);
  }
}

TEST(Motion, LogIsTheNaturalOne) { EXPECT_DOUBLE_EQ(written("log(t)").at(10).x[0], std::log(10.0)); }

TEST(Motion, MinusBindsWeakerThanPower) { EXPECT_DOUBLE_EQ(written("-t^2").at(3).x[0], -9); }

TEST(Motion, StepSwitches) {
  const Motion motion = written("step(t - 1)*(t - 1)^3");
  EXPECT_EQ(motion.at(0.5).x[0], 0);
  EXPECT_EQ(motion.at(0.5).a[0], 0);
  EXPECT_DOUBLE_EQ(motion.at(3).x[0], 8);
  EXPECT_DOUBLE_EQ(motion.at(3).a[0], 12);
  EXPECT_NO_THROW(written("step(1 - t)*t + step(t - 1)"));
}

TEST(Motion, BadExpressionsAreRefusedWithTheReason) {
  expect_refused("abs(t)", "abs has kinks");
  expect_refused("x", "x is not known");
  expect_refused("sine(t)", "sine is not known");
  expect_refused("I*t", "I is not known");
  expect_refused("sin t", "sin needs its argument");
  expect_refused("pi(t)", "pi is no function");
  expect_refused("2t", "an operator is missing");
  expect_refused("t+", "is missing");
  expect_refused("", "it is empty");
  expect_refused("(t", "parentheses do not match");
  expect_refused("t == 1", "the character = means nothing");
  for (const char* text : {"2^3^t", "2^-3^t", "(2^t)^3^t", "sin(t)^2 ^ t", "2^(t)^2", "t*(1 + 2^3^t)"})
    expect_refused(text, "needs parentheses");
  expect_refused("1/0", "division by zero");
  expect_refused("(-1)^0.5*t", "not a real number");
  expect_refused("step(t - 1)", "the position jumps at t = 1 s");
  expect_refused("step(sin(t))", "a + b*t only");
  EXPECT_NE(refusal(std::string(200, '(') + "t" + std::string(200, ')')).find("nested deeper"), std::string::npos);
}

TEST(Motion, ShiftedMovesThePositionAlone) {
  const Motion motion = Motion::waypoints({0, 1, 2}, {{0, 0, 0}, {1, 1, 0}, {0, 2, 0}});
  const Motion shifted = motion.shifted({5, 0, -1});
  EXPECT_EQ(shifted.at(0.4).x, motion.at(0.4).x + Vector3(5, 0, -1));
  EXPECT_EQ(shifted.at(0.4).v, motion.at(0.4).v);
  EXPECT_EQ(shifted.at(0.4).a, motion.at(0.4).a);
  EXPECT_EQ(shifted.last_time(), 2);
}

}   // namespace
}   // namespace cablenet::scene
