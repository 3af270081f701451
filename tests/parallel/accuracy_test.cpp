#include <gtest/gtest.h>

#include <cmath>

#include "cablenet/accuracy/search.hpp"

using namespace cablenet;
using namespace cablenet::accuracy;

namespace {

/// A cable of 100 m for 10 s, with rows each 0.1 s.
scene::Scene open_scene(double accuracy) {
  scene::Scene scene;
  scene.accuracy = accuracy;
  scene.cable_types.emplace_back();
  scene.points.resize(2);
  scene.points[1].position = {100, 0, 0};
  scene.cables.emplace_back();
  scene.cables[0].to = scene::PointEnd{1};
  scene.time.end = 10;
  scene.output.interval = 0.1;
  return scene;
}

/// Runs whose histories are off a known one by a n^-p + b dt^2, or c tolerance^(2/3), of the range.
struct Model {
  double mesh = 0, mesh_order = 2, step = 0, adaptive = 1e9;
  double chaos = 0;            ///< an error that no size brings down, and that no two runs share
  double unseen = 0;           ///< an error that coarse runs do not have
  double least_elements = 0;   ///< Runs with fewer do not come to their end.
  std::vector<Fineness> asked = {};

  double error(double elements, const Stepping& stepping) const {
    const double by_step =
        stepping.tolerance ? adaptive * std::pow(*stepping.tolerance, 2.0 / 3) : step * stepping.step * stepping.step;
    return mesh * std::pow(elements, -mesh_order) + by_step;
  }
  Trial run(const Mesh& grid, const Fineness& sizes) {
    asked.push_back(sizes);
    const double elements = grid.had(sizes.elements);
    if (elements < least_elements) return {};
    Trial trial{true, true, {{"time", "end.x"}, {}}, 0};
    const double off = error(elements, sizes.stepping), phase = 1e3 * elements + 1e5 * sizes.stepping.step;
    for (int i = 0; i <= 100; ++i) {
      const double t = 0.1 * i, true_one = std::sin(t);   // its range is 2, and a root mean square is one over root 2
      const double all = off * std::cos(7 * t) + unseen * std::cos(9 * t) + chaos * std::cos(8 * t + phase);
      trial.history.rows.push_back({t, true_one + 2 * std::sqrt(2.0) * all});
    }
    const double steps =
        sizes.stepping.tolerance ? 10 / std::cbrt(*sizes.stepping.tolerance) : 10 / sizes.stepping.step;
    trial.work = elements * steps;
    return trial;
  }
};

const Bends no_bends = [] { return std::vector<Bending>{{100, std::vector<double>(32, 0.01)}}; };

Search searched(const scene::Scene& scene, Model& model) {
  Search search(
      scene, [&](const Mesh& mesh, const Fineness& sizes) { return model.run(mesh, sizes); }, no_bends);
  search.choose();
  return search;
}

/// The cost of the cheapest sizes, elements over step.
double cheapest(const Model& model, double accuracy) {
  return std::sqrt(2 * model.mesh / accuracy) / std::sqrt(accuracy / (2 * model.step));
}

}   // namespace

TEST(Search, FindsTheCheapestSizesForTheAccuracy) {
  for (const double accuracy : {0.1, 0.01, 0.001}) {
    const scene::Scene scene = open_scene(accuracy);
    Model model{20, 2, 20};
    Search search = searched(scene, model);
    const Fineness chosen = search.chosen();
    EXPECT_FALSE(chosen.stepping.tolerance);
    const double elements = search.mesh().had(chosen.elements);
    const double error = model.error(elements, chosen.stepping);
    EXPECT_LE(error, 1.1 * accuracy);   // The range that errors are scaled by is coarse runs' own.
    EXPECT_GE(error, 0.2 * accuracy);
    EXPECT_LE(elements / chosen.stepping.step, 2 * cheapest(model, accuracy)) << accuracy;
    const Estimate estimate = search.estimate(model.run(search.mesh(), chosen));
    EXPECT_TRUE(search.is_reached());
    EXPECT_EQ(estimate.quantity, "end.x");
    EXPECT_NEAR(estimate.error, error, 0.5 * error);
  }
}

TEST(Search, CoarseRunsCostLessThanTheRunThatIsChosen) {
  const scene::Scene scene = open_scene(0.001);
  Model model{20, 2, 20};
  Search search = searched(scene, model);
  double work = 0;
  for (const Fineness& sizes : std::vector<Fineness>(model.asked)) work += model.run(search.mesh(), sizes).work;
  EXPECT_LE(work, 1.2 * model.run(search.mesh(), search.chosen()).work);
}

TEST(Search, TakesAdaptiveStepsWhereTheyCostLess) {
  const scene::Scene scene = open_scene(0.01);
  Model good{20, 2, 2000, 0.1}, bad{20, 2, 20, 100};
  EXPECT_TRUE(searched(scene, good).chosen().stepping.tolerance);
  EXPECT_FALSE(searched(scene, bad).chosen().stepping.tolerance);
}

TEST(Search, GoesOnWhereCoarseRunsFail) {
  const scene::Scene scene = open_scene(0.01);
  Model model{20, 2, 20};
  model.least_elements = 20;
  scene::Scene given = scene;
  given.time.step = 0.01;
  Search search = searched(given, model);
  EXPECT_LE(model.error(search.mesh().had(search.chosen().elements), {}), 0.01);
  EXPECT_EQ(search.chosen().stepping.step, 0);
}

TEST(Search, RefinesWhereARunErrsByMoreThanItShould) {
  const scene::Scene scene = open_scene(0.01);
  Model model{20, 2, 20};
  Search search = searched(scene, model);
  model.unseen = 0.1;
  const Fineness first = search.chosen();
  Trial run = model.run(search.mesh(), first);
  search.estimate(run);
  ASSERT_FALSE(search.is_reached());
  ASSERT_TRUE(search.can_refine());
  search.refine(std::move(run));
  EXPECT_GT(search.chosen().elements / search.chosen().stepping.step, 1.3 * first.elements / first.stepping.step);
}

TEST(Search, DoesNotClaimWhatItCannotReach) {
  const scene::Scene scene = open_scene(0.01);
  Model model{20, 2, 20};
  model.chaos = 0.2;
  Search search = searched(scene, model);
  for (int i = 0; i < 3; ++i) {
    Trial run = model.run(search.mesh(), search.chosen());
    search.estimate(run);
    EXPECT_FALSE(search.is_reached());
    if (!search.can_refine()) break;
    search.refine(std::move(run));
  }
  EXPECT_FALSE(search.can_refine());
  EXPECT_LE(model.asked.size(), 30u);
}

TEST(Search, KnowsNothingWhereNoRunComesToItsEnd) {
  const scene::Scene scene = open_scene(0.01);
  Model model{20, 2, 20};
  model.least_elements = 1e9;
  Search search = searched(scene, model);
  EXPECT_TRUE(std::isinf(search.estimate({true, true, {{"time"}, {{0}}}}).error));
  EXPECT_FALSE(search.is_reached());
  EXPECT_FALSE(search.can_refine());
}

TEST(Search, TakesMoreElementsWhereThereIsNoEquilibrium) {
  const scene::Scene scene = open_scene(0.01);
  Model model{20, 2, 20};
  const auto run = [&](const Mesh& mesh, const Fineness& sizes) {
    Trial trial = model.run(mesh, sizes);
    if (sizes.elements < 20) trial = {false, false};
    return trial;
  };
  Search search(scene, run, no_bends);
  search.choose();
  EXPECT_DOUBLE_EQ(model.asked[1].elements, 16);
  EXPECT_DOUBLE_EQ(model.asked[1].stepping.step, 0.1);
  EXPECT_LE(model.error(search.mesh().had(search.chosen().elements), search.chosen().stepping), 0.011);
}

TEST(Ladder, SaysWhatItsFinestRunErrsBy) {
  for (const double order : {1.0, 2.0}) {
    Model model{1, order};
    const Mesh mesh(open_scene(0.01));
    Ladder ladder;
    for (const double elements : {8, 16, 32}) ladder.add(1 / elements, model.run(mesh, {elements, {}}));
    const double error = model.error(32, {});
    EXPECT_GE(ladder.error(), 0.5 * error);
    EXPECT_LE(ladder.error(), 1.05 * error);
    EXPECT_FALSE(ladder.is_stuck());
  }
}

TEST(Mesh, SharesElementsOutByBends) {
  scene::Scene scene = open_scene(0.01);
  scene.cables.push_back(scene.cables[0]);
  Mesh mesh(scene);
  EXPECT_EQ(mesh.counts(10), (std::vector<std::pair<std::size_t, int>>{{0, 10}, {1, 10}}));
  std::vector<double> bent(32, 0.08), straight(32, 0.01);
  bent[0] = 0.64;
  mesh.grade({{100, bent}, {100, straight}});
  const auto counts = mesh.counts(40);
  EXPECT_EQ(counts[0].second, 40);
  EXPECT_LT(counts[1].second, 20);
  const scene::Scene made = mesh.divided(scene, 40);
  EXPECT_EQ(made.cables[0].elements, 40);
  EXPECT_TRUE(made.cables[0].has_chosen_mesh);
  EXPECT_GT(made.cables[0].density.front(), 1.5 * made.cables[0].density.back());
}

TEST(History, DifferencesAreScaledByRanges) {
  const std::vector<std::string> columns{"time", "p.x", "p.y", "p.ax", "c.tension_from", "p.fz"};
  const HistoryTable fine{columns, {{0, 0, 0, 0, 10, 5}, {1, 4, 0.1, 9, 14, 5}, {2, 2, 0, 0, 10, 5}}};
  HistoryTable coarse = fine;
  for (auto& row : coarse.rows)
    for (std::size_t c = 1; c < row.size(); ++c) row[c] += 0.04;
  const std::vector<double> found = differences(coarse, fine);
  EXPECT_EQ(found[0], 0);
  EXPECT_NEAR(found[1], 0.01, 1e-12);
  EXPECT_NEAR(found[2], 0.1, 1e-12);   // a tenth of the range of x
  EXPECT_EQ(found[3], 0);
  EXPECT_NEAR(found[4], 0.01, 1e-12);
  EXPECT_NEAR(found[5], 0.04 / 5e-3, 1e-9);   // a thousandth of its size
  // Rows that a history does not have lie linearly between those that it has.
  EXPECT_NEAR(differences({columns, {fine.rows[0], fine.rows[2]}}, fine)[1], std::sqrt(9.0 / 3) / 4, 1e-12);
}

TEST(History, EquilibriaAreScaledByExtentAndSize) {
  const HistoryTable fine{{"time", "p.x", "q.x", "p.fz"}, {{0, 10, 30, 50}}};
  const HistoryTable coarse{fine.columns, {{0, 11, 30, 55}}};
  const std::vector<double> found = differences(coarse, fine);
  EXPECT_NEAR(found[1], 1.0 / 20, 1e-12);
  EXPECT_NEAR(found[3], 5.0 / 50, 1e-12);
}

TEST(Search, AnErrorInTheFirstTenthCounts) {
  const scene::Scene scene = open_scene(0.01);
  Model model{20, 2, 20};
  Search search = searched(scene, model);
  const Trial run = model.run(search.mesh(), search.chosen());
  const Fineness finer = search.finer();
  EXPECT_DOUBLE_EQ(finer.elements, 2 * search.chosen().elements);
  EXPECT_NEAR(finer.stepping.step, search.chosen().stepping.step / 2, 0.3 * finer.stepping.step);
  Trial check = model.run(search.mesh(), finer);
  check.history.rows.resize(11);
  search.estimate(run, check);
  EXPECT_TRUE(search.is_reached());
  check.history.rows[5][1] += 2;   // the range in one row of 101
  EXPECT_NEAR(search.estimate(run, check).error, 4.0 / 3 / std::sqrt(101.0), 0.02);
  EXPECT_FALSE(search.is_reached());
}

TEST(Rows, AreAtLeastFiftyAndTwelveInAPeriod) {
  scene::Scene scene = open_scene(0.01);
  EXPECT_DOUBLE_EQ(interval_of_rows(scene), 0.1);
  scene.output.interval = 10;
  EXPECT_DOUBLE_EQ(interval_of_rows(scene), 0.2);
  EXPECT_TRUE(is_written(scene, 0.2, 0));
  EXPECT_FALSE(is_written(scene, 0.2, 0.2));
  EXPECT_TRUE(is_written(scene, 0.2, 10));
  EXPECT_TRUE(is_written(scene, 0.2, 0.3));   // where a run could not go on
  scene.points[0].motion = scene::Motion::harmonic({0, 0, 0}, {1, 0, 0}, 1.2, 0);
  EXPECT_NEAR(interval_of_rows(scene), 0.1, 2e-3);
  scene.output.interval = 0;
  EXPECT_TRUE(is_written(scene, 0.2, 0.123));
}
