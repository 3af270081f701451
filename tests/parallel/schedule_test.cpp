#include "cablenet/solve/schedule.hpp"

#include <gtest/gtest.h>

#include <vector>

using cablenet::solve::Schedule;

namespace {

/// All times up to the end, where each step is taken as the schedule plans it.
std::vector<double> times(Schedule& schedule) {
  std::vector<double> found{schedule.time()};
  while (!schedule.at_end() && found.size() < 10000) {
    schedule.advance(schedule.next_step(), false);
    found.push_back(schedule.time());
  }
  return found;
}

}   // namespace

TEST(Schedule, OutputsAreAtExactMultiplesOfTheInterval) {
  Schedule schedule(0.3, 2.3, 0.007, 0.1);
  EXPECT_TRUE(schedule.at_output());
  int outputs = 0;
  for (int i = 0; i < 10000 && !schedule.at_end(); ++i) {
    EXPECT_LE(schedule.next_step(), 0.007 * (1 + 1e-8));
    schedule.advance(schedule.next_step(), false);
    if (!schedule.at_output()) continue;
    ++outputs;
    EXPECT_EQ(schedule.time(), outputs == 20 ? 2.3 : 0.3 + outputs * 0.1);
  }
  EXPECT_EQ(outputs, 20);
  EXPECT_EQ(schedule.time(), 2.3);
}

TEST(Schedule, StepsBetweenOutputsAreEven) {
  Schedule schedule(0, 1, 0.3, 0.5);
  const std::vector<double> found = times(schedule);
  ASSERT_EQ(found.size(), 5u);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_DOUBLE_EQ(found[i], 0.25 * static_cast<double>(i));
}

TEST(Schedule, AStepThatFitsIsNotShortenedByRounding) {
  Schedule schedule(0, 0.3, 0.1, 0.3);
  EXPECT_EQ(times(schedule).size(), 4u);
  Schedule finer(0, 2.8, 2e-2, 1e-1);
  EXPECT_EQ(times(finer).size(), 141u);
}

TEST(Schedule, WithoutAnIntervalEveryStepIsOutput) {
  Schedule schedule(1, 2, 0.3, 0);
  int steps = 0;
  for (; steps < 100 && !schedule.at_end(); ++steps) {
    EXPECT_DOUBLE_EQ(schedule.next_step(), 0.25);
    schedule.advance(schedule.next_step(), false);
    EXPECT_TRUE(schedule.at_output());
  }
  EXPECT_EQ(steps, 4);
  EXPECT_EQ(schedule.time(), 2);
}

TEST(Schedule, AnEndOffTheIntervalIsAnOutput) {
  Schedule schedule(0, 1, 0.4, 0.4);
  const std::vector<double> found = times(schedule);
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[1], 0.4);
  EXPECT_EQ(found[2], 0.8);
  EXPECT_EQ(found[3], 1);
  EXPECT_TRUE(schedule.at_output());
}

TEST(Schedule, AnIntervalBeyondTheEndLeavesTheEnd) {
  Schedule schedule(0, 1, 0.5, 7);
  EXPECT_EQ(times(schedule).size(), 3u);
  EXPECT_TRUE(schedule.at_output());
  EXPECT_EQ(schedule.time(), 1);
}

TEST(Schedule, AnIntervalBelowTheStepIsTheStep) {
  Schedule schedule(0, 1, 0.5, 0.125);
  EXPECT_EQ(times(schedule).size(), 9u);
}

TEST(Schedule, ARetryShrinksTheStepAndItGrowsBack) {
  Schedule schedule(0, 100, 1, 10);
  schedule.advance(1, false);
  schedule.advance(1.0 / 16, true);
  EXPECT_DOUBLE_EQ(schedule.time(), 1 + 1.0 / 16);
  EXPECT_FALSE(schedule.at_output());
  double step = 0, limit = 1.0 / 16;
  for (int i = 0; i < 12; ++i) {
    step = schedule.next_step();
    EXPECT_LE(step, limit * (1 + 1e-8));
    EXPECT_GT(step, 0.9 * limit);
    schedule.advance(step, false);
    if (i % 4 == 3) limit *= 2;
  }
  double last = 0;
  bool output_at_10 = false;
  for (int i = 0; i < 200 && !schedule.at_end(); ++i) {
    last = schedule.next_step();
    schedule.advance(last, false);
    output_at_10 = output_at_10 || (schedule.at_output() && schedule.time() == 10);
  }
  EXPECT_TRUE(output_at_10);
  EXPECT_EQ(schedule.time(), 100);
  EXPECT_DOUBLE_EQ(last, 1);
}

TEST(Schedule, ARetryBeforeAnOutputDoesNotMissIt) {
  Schedule schedule(0, 2, 0.25, 1);
  for (int i = 0; i < 3; ++i) schedule.advance(schedule.next_step(), false);
  schedule.advance(schedule.next_step() / 4, true);
  schedule.advance(schedule.next_step() / 4, true);
  int steps = 0;
  while (!schedule.at_output() && ++steps < 100) schedule.advance(schedule.next_step(), false);
  EXPECT_EQ(schedule.time(), 1);
  EXPECT_LE(steps, 8);
  EXPECT_GE(steps, 3);
}

TEST(Schedule, AMillionStepsEndExactly) {
  Schedule schedule(0, 1, 1e-6, 0);
  long steps = 0;
  for (; !schedule.at_end() && steps < 1100000; ++steps) schedule.advance(schedule.next_step(), false);
  EXPECT_EQ(steps, 1000000);
  EXPECT_EQ(schedule.time(), 1);
  Schedule with_outputs(0, 1, 1e-6, 1e-2);
  for (steps = 0; !with_outputs.at_end() && steps < 1100000; ++steps)
    with_outputs.advance(with_outputs.next_step(), false);
  EXPECT_EQ(steps, 1000000);
  EXPECT_EQ(with_outputs.time(), 1);
}

TEST(Schedule, ALimitIsCutToTheNextOutput) {
  Schedule schedule(0, 10, 0.5, 1);
  schedule.advance(schedule.next_step(), false);
  schedule.set_limit(0.4);
  EXPECT_DOUBLE_EQ(schedule.next_step(), 0.25);
  schedule.set_limit(3);
  EXPECT_DOUBLE_EQ(schedule.next_step(), 0.5);
  schedule.advance(schedule.next_step(), false);
  EXPECT_EQ(schedule.time(), 1);
  EXPECT_TRUE(schedule.at_output());
  schedule.set_limit(3);
  EXPECT_DOUBLE_EQ(schedule.next_step(), 1);
}

TEST(Schedule, ALimitSetFromOutsideIsKept) {
  Schedule schedule(0, 100, 1, 0);
  schedule.advance(1.0 / 16, true);
  schedule.set_limit(1.0 / 16);
  for (int i = 0; i < 40; ++i) {
    EXPECT_LE(schedule.next_step(), 1.0 / 16 * (1 + 1e-8));
    schedule.advance(schedule.next_step(), false);
    schedule.set_limit(1.0 / 16);
  }
  schedule.set_limit(4);
  EXPECT_GT(schedule.next_step(), 3.5) << "longer than at the start";
  const double h = schedule.next_step();
  schedule.advance(h, false);
  schedule.set_limit(4);
  EXPECT_EQ(schedule.next_step(), h) << "the plan stands";
}
