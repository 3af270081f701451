#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "../support/networks.hpp"
#include "../support/scenes.hpp"
#include "cablenet/solve/dynamics.hpp"
#include "cablenet/solve/frame_velocity.hpp"
#include "cablenet/solve/scheme.hpp"
#include "cablenet/solve/statics.hpp"

using namespace cablenet;
using namespace cablenet::test;
using scene::Scheme;

namespace {

struct Case {
  const char* name;
  Scheme scheme;
  double radius;
  std::optional<double> tolerance;
  const std::string* text;
  double step = 0.01;
  const char* option = nullptr;   ///< and "0" for it
  friend void PrintTo(const Case& item, std::ostream* out) { *out << item.name; }
};

const std::string shaken = R"(
environment: {gravity: 9.81}
points:
  top: {position: [0, 0, 0], motion: {harmonic: {amplitude: [0, 0.05, 0.1], period: 0.9}}}
  tip: {position: [3, 0, 0], mass: 1, velocity: [0, 2, 0]}
cables: {chain: {type: rope, from: top, to: tip, elements: 9}}
)";

scene::Scene scene_of(const Case& item) {
  scene::Scene scene = test::scene_of(*item.text);
  scene.time = {0, 2, item.step, item.scheme, item.radius, 0, item.tolerance};
  return scene;
}

/// The files of tests/cases/valid and tests/cases/scenes, and those that scripts of tests/cases make of scenes.
std::vector<std::filesystem::path> scene_files() {
  std::vector<std::filesystem::path> files;
  const std::filesystem::path cases = std::filesystem::path(CABLENET_ROOT) / "tests" / "cases";
  for (const auto& folder : {cases / "valid", cases / "scenes", std::filesystem::path(CABLENET_MADE_SCENES)})
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// A scene as in its file, but with an end that is later, so that it has 20 steps.
scene::Scene scene_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  scene::Scene scene = scene::read_scene(text.str(), file.string());
  // This scene shows every key.  It has no equilibrium, so it starts as it is drawn.
  if (file.stem() == "everything") scene.starts_static = false;
  scene.time.end += 20 * std::max(scene.time.step, scene.output.interval);
  return scene;
}

/// What a run is at its end, and the steps on the way there.
struct End {
  Field x, v, a;
  std::vector<double> steps, energies;
  std::map<long, Archive> saved;   ///< by the number of steps done
};

/// One of two programs that run the same scene.
class Runner {
public:
  explicit Runner(const scene::Scene& scene)
      : scene_(scene), system_(network::build_network(scene), solve::force_rule_of(scene.time), PETSC_COMM_WORLD) {}

  /// As far as 20 steps, and saves after some of them.
  End run(const std::set<long>& saves) {
    if (!dynamics_ && scene_.starts_static) find_equilibrium();
    if (!dynamics_) make_dynamics();
    End end;
    dynamics_->run({[&](const solve::Instant& instant) {
                      end.x = system_.field(instant.x);
                      end.v = system_.field(instant.v);
                      end.a = system_.field(instant.a);
                      system_.assembler.observe(instant.t, instant.x, instant.v, instant.a);
                      const system::Energies part = system_.assembler.energies();
                      end.energies = {part.kinetic, part.strain, part.gravity, part.work, part.dissipated,
                                      part.damping, part.water,  part.bed,     part.start};
                    },
                    [&](double, double dt, const solve::Counts& counts) {
                      if (counts.steps > 10) end.steps.push_back(dt);
                      if (saves.contains(counts.steps)) dynamics_->archive(end.saved[counts.steps]);
                    }});
    return end;
  }
  /// The next run goes on from there.  It does not look for an equilibrium.
  void load(const Archive& saved) {
    make_dynamics();
    Archive archive(saved.entries());
    dynamics_->archive(archive);
  }

private:
  /// Makes the equilibrium the start, as the program does.
  void find_equilibrium() {
    const double t = scene_.time.start, window = 0.1 * (scene_.time.end - t);
    solve::Statics statics(system_.assembler, t, solve::frame_velocity(system_.assembler, t, window));
    ASSERT_TRUE(statics.solve()) << statics.failure();
    statics.make_start();
  }
  void make_dynamics() {
    solve::Dynamics::Settings settings{scene_.output.interval, nullptr, 20};
    settings.keeps_accounts = true;
    settings.is_watched = false;
    settings.takes_notes = true;
    dynamics_.emplace(system_.assembler, scene_.time, settings);
  }

  scene::Scene scene_;
  System system_;
  std::optional<solve::Dynamics> dynamics_;
};

class Resume : public testing::TestWithParam<Case> {
protected:
  Resume() {
    if (GetParam().option != nullptr) option_.emplace(GetParam().option, "0");
  }

private:
  std::optional<Option> option_;
};

void expect_equal(const Archive& one, const Archive& other) {
  ASSERT_EQ(one.entries().size(), other.entries().size());
  for (std::size_t i = 0; i < one.entries().size(); ++i) {
    EXPECT_EQ(one.entries()[i].name, other.entries()[i].name);
    EXPECT_EQ(one.entries()[i].numbers, other.entries()[i].numbers) << one.entries()[i].name;
  }
}

/// 20 steps against 10, saving, loading into new objects, and 10.
/// @returns the former run
End expect_bit_for_bit(const scene::Scene& scene) {
  const End whole = Runner(scene).run({10, 11, 20});
  EXPECT_EQ(whole.steps.size(), 10u);
  if (whole.steps.size() != 10) return whole;
  Runner second(scene);
  second.load(whole.saved.at(10));
  const End resumed = second.run({11, 20});
  EXPECT_EQ(whole.steps, resumed.steps);
  EXPECT_EQ(whole.x, resumed.x);
  EXPECT_EQ(whole.v, resumed.v);
  EXPECT_EQ(whole.a, resumed.a);
  EXPECT_EQ(whole.energies, resumed.energies);
  for (const long steps : {11, 20}) expect_equal(whole.saved.at(steps), resumed.saved.at(steps));
  return whole;
}

class ResumedScenes : public testing::TestWithParam<std::filesystem::path> {};

}   // namespace

TEST_P(Resume, TwentyStepsAreTenAndTenBitForBit) {
  const End whole = expect_bit_for_bit(scene_of(GetParam()));
  // Newton's history changes the path of few scenes.
  const auto& entries = whole.saved.at(10).entries();
  EXPECT_TRUE(std::any_of(entries.begin(), entries.end(), [](const auto& e) { return e.name == "newton.curvature"; }));
}

/// The acceleration is taken over, too: without it the path would be another by the first step's error.
TEST_P(Resume, SavingLeavesThePathButForRounding) {
  const End whole = Runner(scene_of(GetParam())).run({10}), never_saved = Runner(scene_of(GetParam())).run({});
  ASSERT_EQ(whole.steps.size(), never_saved.steps.size());
  for (std::size_t i = 0; i < whole.steps.size(); ++i) EXPECT_NEAR(whole.steps[i], never_saved.steps[i], 1e-12);
  EXPECT_LE(size(difference(whole.x, never_saved.x)), 1e-8 * size(whole.x));
  EXPECT_LE(size(difference(whole.v, never_saved.v)), 1e-6 * size(whole.v));
}

TEST_P(Resume, AnotherNetworkIsRefused) {
  const End whole = Runner(scene_of(GetParam())).run({10});
  Case other = GetParam();
  other.text = &two_cables;
  Runner second(scene_of(other));
  // Not all ranks need have a share of another size.
  int refused = 0;
  try {
    second.load(whole.saved.at(10));
  } catch (const InputError&) {
    refused = 1;
  }
  MPI_Allreduce(MPI_IN_PLACE, &refused, 1, MPI_INT, MPI_LOR, PETSC_COMM_WORLD);
  EXPECT_EQ(refused, 1);
}

INSTANTIATE_TEST_SUITE_P(
    Runs, Resume,
    testing::Values(Case{"energy_momentum", Scheme::energy_momentum, 1, {}, &shaken},
                    Case{"generalized_alpha", Scheme::generalized_alpha, 0.6, {}, &shaken},
                    Case{"plain", Scheme::plain, 0.8, {}, &array},
                    Case{"adaptive", Scheme::generalized_alpha, 0.8, 1e-5, &shaken, 1e-3},
                    Case{"adaptive_mean", Scheme::energy_momentum, 1, 1e-6, &shaken},
                    Case{"kept_tangents", Scheme::generalized_alpha, 0.8, {}, &net, 0.01, "-cable_elimination_limit"},
                    Case{"one_iteration_a_step", Scheme::energy_momentum, 1, {}, &shaken, 1e-4}),
    [](const auto& item) { return item.param.name; });

TEST_P(ResumedScenes, TwentyStepsAreTenAndTenBitForBit) { expect_bit_for_bit(scene_of(GetParam())); }

INSTANTIATE_TEST_SUITE_P(Files, ResumedScenes, testing::ValuesIn(scene_files()),
                         [](const auto& item) { return item.param.stem().string(); });
