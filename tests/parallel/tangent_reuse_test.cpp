#include "cablenet/solve/tangent_reuse.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../support/networks.hpp"
#include "cablenet/solve/newton_convergence.hpp"
#include "cablenet/solve/newton_progress.hpp"

using namespace cablenet;
using namespace cablenet::test;

namespace {

class TangentReuse : public testing::Test {
protected:
  /// Which corrections of a solve used new tangents.
  static std::vector<bool> solve(solve::TangentReuse& reuse, double key, const std::vector<double>& contractions,
                                 bool careful = false) {
    std::vector<bool> fresh;
    reuse.begin_solve(key, careful);
    for (std::size_t i = 0; i < contractions.size(); ++i) {
      fresh.push_back(reuse.wants_new());
      if (fresh.back()) reuse.note_computed();
      EXPECT_EQ(reuse.was_kept(), !fresh.back());
      reuse.note_correction(static_cast<int>(i) + 1, contractions[i]);
    }
    return fresh;
  }
};

using Fresh = std::vector<bool>;

}   // namespace

TEST_F(TangentReuse, KeepsWhatServes) {
  solve::TangentReuse reuse(true);
  EXPECT_FALSE(reuse.computes_always());
  EXPECT_EQ(solve(reuse, 0.1, {1e-3, 1e-3, 0.1, 0.1}), (Fresh{true, true, false, false}))
      << "after two good corrections";
  EXPECT_EQ(solve(reuse, 0.1, {1e-3, 0.1}), (Fresh{false, false})) << "over a step in which all served";
  EXPECT_EQ(solve(reuse, 0.1 * (1 + 1e-12), {0.1, 0.1}), (Fresh{false, false})) << "a step that differs by rounding";
}

TEST_F(TangentReuse, RefreshesWhatDoesNot) {
  solve::TangentReuse reuse(true);
  EXPECT_EQ(solve(reuse, 0.1, {1e-3, 0.1, 1e-3, 1e-3, 0.5, 1e-3}), (Fresh{true, true, true, true, false, true}));
  EXPECT_EQ(solve(reuse, 0.1, {1e-3, 1e-3, 0.1}), (Fresh{true, true, false})) << "after a step with slow corrections";
  EXPECT_EQ(solve(reuse, 0.1, {0.5, 1e-3, 0.1}), (Fresh{false, true, false}))
      << "a trusted tangent that no longer serves";
  EXPECT_EQ(solve(reuse, 0.05, {1e-3, 1e-3, 0.1}), (Fresh{true, true, false})) << "another step size";
  EXPECT_EQ(solve(reuse, 0.05, {1e-3, 1e-3, 1e-3}, true), (Fresh{true, true, true})) << "a retry";
  EXPECT_EQ(solve(reuse, -0.05, {1e-3, 1e-3}), (Fresh{true, true})) << "the start phase";
  EXPECT_EQ(solve(reuse, 0.05, {1e-3}), (Fresh{true})) << "after the start phase";
  EXPECT_EQ(solve(reuse, 0.05, std::vector<double>(13, 0.01)).at(12), true) << "a solve without end";
}

TEST_F(TangentReuse, KeepsNothingWhereFactorsAreCheap) {
  solve::TangentReuse reuse(false);
  EXPECT_TRUE(reuse.computes_always());
  EXPECT_EQ(solve(reuse, 0.1, {1e-3, 1e-3, 1e-3}), (Fresh{true, true, true}));
  EXPECT_EQ(solve(reuse, 0.1, {1e-3}), (Fresh{true}));
}

namespace {

constexpr double of_rounding = 1e-9;

/// Does Newton's method end at the last of these residual norms?  The test fails if it ends before.
bool ends(const std::vector<double>& norms, bool kept, bool is_retry = false) {
  solve::NewtonConvergence convergence;
  bool verdict = false;
  for (std::size_t i = 0; i < norms.size(); ++i) {
    EXPECT_FALSE(verdict) << "before " << norms[i];
    verdict = convergence.is_at_rounding(static_cast<int>(i), norms[i], 0, of_rounding, is_retry, kept && i > 1);
  }
  return verdict;
}

}   // namespace

TEST(NewtonConvergence, EndsWhereItsErrorIsBelowRounding) {
  EXPECT_TRUE(ends({1, 1e-4, 4e-10}, false)) << "quadratic: an error of 1e-12 is left";
  EXPECT_FALSE(ends({1e-2, 1e-4, 4e-10}, false)) << "an error of 1e-8 is left, though it does not show";
  EXPECT_FALSE(ends({1, 1e-2, 1e-3, 4e-10}, true)) << "linear: an error of 1e-4 is left";
  EXPECT_TRUE(ends({1, 1e-2, 1e-4, 1e-6, 1e-8, 4e-10, 4e-12}, true));
  EXPECT_FALSE(ends({1e-10}, false)) << "a guess is corrected at least once";
}

TEST(NewtonConvergence, AResidualBelowRoundingBoundsTheCurvature) {
  solve::NewtonConvergence convergence;
  const auto ends_after = [&](double guess, double corrected) {
    EXPECT_FALSE(convergence.is_at_rounding(0, guess, 0, of_rounding, false, false));
    return convergence.is_at_rounding(1, corrected, 0, of_rounding, false, false);
  };
  EXPECT_FALSE(ends_after(1, 4e-10)) << "nothing is known yet";
  EXPECT_TRUE(ends_after(0.1, 4e-10)) << "at most 4e-12 is left";
  EXPECT_FALSE(ends_after(0.1, 4e-10)) << "4e-8 is the last bound: at most 4e-10 is left";
  EXPECT_FALSE(ends_after(1, 1e-5)) << "now the curvature is seen, 1e-5";
  EXPECT_FALSE(ends_after(0.01, 1e-14)) << "1e-9 is left";
  EXPECT_FALSE(ends_after(0.01, 1e-14)) << "what is seen stands";
}

namespace {

/// First corrections of solves one after the other.
struct FirstCorrections {
  solve::NewtonConvergence convergence;

  /// @param farther     NewtonConvergence::begin_solve()'s; `guess` and `correction` are those of a guess not moved
  /// @returns whether one correction is enough that brings the residual from `guess` to `corrected`
  bool suffice(double guess, double corrected, double farther = 1, double correction = 1) {
    convergence.begin_solve(farther);
    EXPECT_FALSE(convergence.is_at_rounding(0, farther * guess, 0, of_rounding, false, false));
    return convergence.is_at_rounding(1, corrected, farther * correction, of_rounding, false, false);
  }
};

}   // namespace

TEST(NewtonConvergence, AMovedGuessShowsThatNothingIsHidden) {
  FirstCorrections first;
  EXPECT_FALSE(first.suffice(0.1, 4e-10));
  EXPECT_TRUE(first.convergence.was_in_doubt());
  EXPECT_FALSE(first.suffice(0.1, 2e-9, 30)) << "the solve that shows it is ended by another correction";
  EXPECT_TRUE(first.suffice(0.1, 4e-10)) << "2e-9 / 900 is left";
  EXPECT_FALSE(first.convergence.was_in_doubt());
  EXPECT_FALSE(first.suffice(0.1, 6e-10)) << "above half the rounding";
  EXPECT_TRUE(first.suffice(0.15, 4e-10));
  EXPECT_FALSE(first.suffice(0.3, 4e-10)) << "a worse guess leaves 9 times as much";
  EXPECT_FALSE(first.suffice(0.1, 4e-10, 1, 3)) << "a longer correction as well";
}

TEST(NewtonConvergence, AMovedGuessShowsThatSomethingIsHidden) {
  FirstCorrections first;
  first.suffice(0.1, 4e-10);
  EXPECT_FALSE(first.suffice(0.1, 9e-8, 30));
  EXPECT_FALSE(first.suffice(0.1, 4e-10)) << "9e-8 / 900 is left, which adds up";
  EXPECT_FALSE(first.suffice(0.05, 4e-10)) << "a guess with less of a stiff error can leave as much";
  EXPECT_TRUE(first.convergence.was_in_doubt());
}

TEST(NewtonConvergence, ForgetsWhatAMovedGuessHasShown) {
  FirstCorrections first;
  first.suffice(0.1, 1e-9, 30);
  int solves = 0;
  while (solves < 2000 && first.suffice(0.1, 4e-10)) ++solves;
  EXPECT_NEAR(solves, 440, 2) << "until 1e-9 / 900 times 1.005 in each is 1e-11";
}

TEST(NewtonConvergence, WhatItLearntIsSavedAndLoaded) {
  solve::NewtonConvergence learnt, loaded, knows_nothing;
  learnt.is_at_rounding(0, 1, 0, of_rounding, false, false);
  learnt.is_at_rounding(1, 1e-4, 0, of_rounding, false, false);
  Archive saved;
  learnt.archive(saved);
  Archive archive(saved.entries());
  loaded.archive(archive);
  for (auto* convergence : {&learnt, &loaded, &knows_nothing})
    EXPECT_FALSE(convergence->is_at_rounding(0, 1e-4, 0, of_rounding, false, false));
  EXPECT_TRUE(learnt.is_at_rounding(1, 4e-10, 0, of_rounding, false, false));
  EXPECT_TRUE(loaded.is_at_rounding(1, 4e-10, 0, of_rounding, false, false));
  EXPECT_FALSE(knows_nothing.is_at_rounding(1, 4e-10, 0, of_rounding, false, false));
}

TEST(NewtonConvergence, EndsWhereNothingIsGained) {
  EXPECT_TRUE(ends({1e-2, 1e-4, 6e-9, 5e-9}, false));
  EXPECT_FALSE(ends({1e-2, 1e-4, 6e-8, 5e-8}, false));
  EXPECT_FALSE(ends({1e-2, 1e-4, 6e-9, 5e-9}, true)) << "a new tangent may gain something";
  EXPECT_TRUE(ends({1e-2, 6e-9}, false, true)) << "a retry's careful line search";
}

TEST(NewtonProgress, GoesOnAsLongAsTheResidualFalls) {
  solve::NewtonProgress progress;
  double norm = 1;
  for (int i = 0; i < 100; ++i, norm *= 0.96) {
    progress.note(i, norm, 0);
    EXPECT_TRUE(progress.goes_on()) << "correction " << i;
  }
  for (int i = 100; i < 130; ++i) progress.note(i, norm, 0);
  EXPECT_FALSE(progress.goes_on());
  progress.note(0, 5 * norm, 0);
  EXPECT_TRUE(progress.goes_on()) << "in the next solve";
  norm = 1e8;
  for (int i = 1; i < 40; ++i, norm *= 0.5) progress.note(i, norm, 0);
  EXPECT_TRUE(progress.goes_on()) << "it falls from far above the best";
  for (int i = 40; i < 60; ++i) progress.note(i, i % 2 == 0 ? 10 * norm : norm, 0);
  EXPECT_FALSE(progress.goes_on()) << "it swings";
}

TEST(NewtonProgress, SeesThatAResidualReturns) {
  solve::NewtonProgress progress;
  const std::vector<double> norms{5, 1, 29, 1.8, 29.1, 14, 3};
  const std::vector<bool> returns{false, false, false, false, true, false, false};
  for (std::size_t i = 0; i < norms.size(); ++i) {
    progress.note(static_cast<int>(i), norms[i], 0);
    EXPECT_EQ(progress.returns(), returns[i]) << "correction " << i;
    EXPECT_EQ(progress.cycles(), i >= 4) << "correction " << i;
  }
  progress.note(0, 3, 0);
  EXPECT_FALSE(progress.cycles()) << "in the next solve";
  for (int i = 1; i < 6; ++i) progress.note(i, 1e-9, 1e-8);
  EXPECT_FALSE(progress.cycles()) << "rounding alone";
}

/// What sticks and slips by turns may need several corrections to come round.
TEST(NewtonProgress, SeesLongerCycles) {
  solve::NewtonProgress progress;
  const double cycle[] = {7, 2, 31, 4, 11};
  for (int i = 0; i < 12; ++i) {
    progress.note(i, cycle[i % 5] * (1 + 1e-6 * i), 0);
    EXPECT_EQ(progress.returns(), i >= 5) << "correction " << i;
    EXPECT_EQ(progress.cycles(), i >= 5) << "correction " << i;
  }
  progress.note(0, 7, 0);
  EXPECT_FALSE(progress.returns()) << "what the solve before had does not count";
  for (int i = 1; i < 12; ++i) {
    progress.note(i, cycle[i % 5] * std::pow(0.99, i), 0);
    EXPECT_FALSE(progress.cycles()) << "what falls by a hundredth is another residual";
  }
  for (int i = 0; i < 12; ++i) progress.note(i, 1e-9 * cycle[i % 5], 1e-7);
  EXPECT_FALSE(progress.cycles()) << "rounding alone";
}
