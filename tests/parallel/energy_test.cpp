#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "../support/networks.hpp"
#include "cablenet/solve/dynamics.hpp"
#include "cablenet/solve/energy_watch.hpp"
#include "cablenet/solve/scheme.hpp"

/// These tests hold the energy accounts against each other and against what is known of the losses.
namespace cablenet::test {
namespace {

using scene::Scheme;

struct SchemeCase {
  const char* name;
  Scheme scheme;
  double radius, axial_dissipation;
  friend void PrintTo(const SchemeCase& item, std::ostream* out) { *out << item.name; }
};
const SchemeCase conserving{"energy_momentum", Scheme::energy_momentum, 1, 0};

struct SceneCase {
  const char* name;
  const char* text;
  friend void PrintTo(const SceneCase& item, std::ostream* out) { *out << item.name; }
};

const SceneCase vacuum[] = {{"free_chain", R"(
environment: {gravity: 9.81}
points:
  a: {position: [0, 0, 0], velocity: [0, 3, 0], mass: 0.5, force: [0, 0, 7]}
  b: {position: [8, 0, 0], velocity: [0, -2, 1]}
cables: {chain: {type: rope, from: a, to: b, elements: 11, length: 7.9}}
)"},
                            {"body_on_ropes", R"(
environment: {gravity: 9.81}
points:
  p: {position: [-2, 0, 0], motion: fixed}
  q: {position: [2, 0, 0], motion: {harmonic: {amplitude: [0, 0.1, 0.2], period: 0.7}}}
bodies:
  one: {mass: 3, inertia: [0.4, 0.5, 0.6, 0.05, -0.02, 0.03], position: [0, 0, -2], angular_velocity: [1, -2, 3],
        torque: [0.2, 0.1, -0.3], force: [0, 1, 0], attachments: {a: [-0.3, 0.1, 0.2], b: [0.3, -0.1, 0.2], c: [0, 0, -0.2]}}
  two: {mass: 1, inertia: [0.1, 0.1, 0.1], position: [0, 0, -4], velocity: [1, 0, 0], attachments: {top: [0, 0, 0.1]},
        rotation: euler}
  three: {mass: 1, inertia: [0.1, 0.2, 0.1], position: [1, 0, -4], attachments: {top: [0, 0, 0.1]},
          coupling: {rigid_link: {axial_stiffness: 1e5}}}
cables:
  first: {type: rope, from: p, to: one.a, elements: 4}
  second: {type: damped, from: q, to: one.b, elements: 4}
  third: {type: slack, from: one.c, to: two.top, elements: 3, length: 1.9}
  fourth: {type: rope, from: one.c, to: three.top, elements: 2}
)"},
                            {"snap", R"(
environment: {gravity: 9.81}
points:
  top: {position: [0, 0, 0], motion: fixed}
  low: {position: [0.4, 0, 0.5], mass: 2}
cables: {line: {type: slack, from: top, to: low, elements: 5, length: 2}}
)"},
                            {"damped_and_moved", R"(
environment: {gravity: 9.81}
points:
  top: {position: [0, 0, 0], motion: {harmonic: {amplitude: [0, 0.05, 0.1], period: 0.9}}, mass: 1}
  tip: {position: [3, 0, 0], mass: 1, velocity: [0, 2, 0], force: {waypoints: [[0, 0, 0, 0], [0.5, 3, 0, 4], [2, 0, 0, 0]]}}
  far: {position: [3, 0, -2], motion: {velocity: [0.3, 0, 0]}}
cables:
  chain: {type: damped, from: top, to: tip, elements: 9}
  other: {type: rope, from: tip, to: far, elements: 4}
)"}};

const SceneCase surrounded[] = {{"waves_and_bed", R"(
environment:
  gravity: 9.81
  fluid: {density: 1025, surface: 0, depth: 5, current: {velocity: [0.3, 0.1, 0]}, waves: [{height: 0.4, period: 2, direction: 20}]}
  seabed: {level: -5, stiffness: 2.0e4, damping: 2.0e3, friction: 0.4}
points:
  top: {position: [0, 0, 0.5], motion: {harmonic: {amplitude: [0.1, 0, 0.1], period: 1.3}}}
  tail: {position: [6, 0, -5], volume: 0.002, drag_area: 0.02, added_mass: 1, mass: 3}
cables: {line: {type: wet, from: top, to: tail, elements: 12, length: 8.2}}
)"},
                                {"body_in_water", R"(
environment: {gravity: 9.81, fluid: {density: 1025}}
points: {top: {position: [0, 0, 0], motion: {velocity: [0.5, 0, 0]}}}
bodies:
  fish: {mass: 30, inertia: [1, 2, 2], position: [-3, 0, -2], angular_velocity: [0.5, -0.4, 0.3], volume: 0.02,
         center_of_buoyancy: [0, 0, 0.1], attachments: {nose: [0.5, 0, 0.1]},
         drag: {linear: [1, 2, 2, 1, 1, 1], quadratic: [5, 40, 40, 2, 3, 3]}, added_mass: [3, 15, 15, 0.1, 0.5, 0.5]}
cables: {line: {type: wet, from: top, to: fish.nose, elements: 7}}
)"}};

scene::Scene scene_in(const SceneCase& item, const SchemeCase& by, double end, double step) {
  const std::string types =
      "cable_types:\n"
      "  rope: {mass_per_length: 0.5, axial_stiffness: 2000, diameter: 0.02}\n"
      "  slack: {mass_per_length: 0.3, axial_stiffness: 1500, tension_only: true, diameter: 0.02}\n"
      "  damped: {diameter: 0.02, mass_per_length: 0.4, axial_stiffness: 1000, axial_damping: 8, rayleigh: {mass: 0.7, "
      "stiffness: "
      "2.0e-3}}\n"
      "  wet: {mass_per_length: 1.5, axial_stiffness: 3000, diameter: 0.03, normal_drag: 1.2, tangential_drag: 0.05, "
      "added_mass: 1, axial_damping: 20}\n"
      "time: {end: 1, step: 0.1}\n";
  scene::Scene scene = scene::read_scene(types + item.text, "test.yaml");
  scene.time = {0, end, step, by.scheme, by.radius, by.axial_dissipation};
  return scene;
}

/// A run that keeps accounts, or one of a scene that asks for none.
class Accounted {
public:
  explicit Accounted(const scene::Scene& scene, const char* prefix = nullptr, bool asks = true)
      : system_(network::build_network(scene), solve::force_rule_of(scene.time), PETSC_COMM_WORLD),
        dynamics_(system_.assembler, scene.time, settings(prefix, asks)) {
    verdict = dynamics_.run({[&](const solve::Instant& instant) {
                               system_.assembler.observe(instant.t, instant.x, instant.v, instant.a);
                               const system::Energies part = system_.assembler.energies();
                               observed_balance = sum_over_ranks(part.balance());
                               system_.assembler.look_at_energy();
                             },
                             [](double, double, const solve::Counts&) {}});
    is_followed = system_.assembler.energy_summary() != nullptr;
    if (is_followed) summary = *system_.assembler.energy_summary();
  }
  const system::Energies& now() const { return summary.now; }
  bool has_gained() const { return dynamics_.has_gained_energy(); }

  solve::Verdict verdict{};
  bool is_followed = false;
  system::EnergySummary summary;
  double observed_balance = 0;

private:
  static solve::Dynamics::Settings settings(const char* prefix, bool asks) {
    solve::Dynamics::Settings made{asks ? 0.0 : 0.05, prefix};
    made.keeps_accounts = asks;
    made.takes_notes = !asks;
    return made;
  }

  System system_;
  solve::Dynamics dynamics_;
};

class Balance : public testing::TestWithParam<std::tuple<SceneCase, SchemeCase>> {};

}   // namespace

/// What each account takes is computed from forces, and the balance from energies: they agree to what Newton's method
/// leaves, 1e-12 of the loads in each of 200 steps.
TEST_P(Balance, ClosesAtEveryStep) {
  const auto& [item, by] = GetParam();
  const Accounted run(scene_in(item, by, 1, 0.005));
  EXPECT_EQ(run.verdict, solve::Verdict::finished);
  EXPECT_GT(run.summary.moved, 0.1);
  EXPECT_LE(run.summary.imbalance, 1e-9 * run.summary.moved);
  EXPECT_LE(std::abs(run.observed_balance), 1e-9 * run.summary.moved);
}

const auto name_of = [](const auto& item) {
  return std::string(std::get<0>(item.param).name) + "_" + std::get<1>(item.param).name;
};

const SchemeCase schemes[] = {conserving,
                              {"dissipating", Scheme::energy_momentum, 1, 0.05},
                              {"generalized_alpha", Scheme::generalized_alpha, 0.6, 0},
                              {"plain", Scheme::plain, 0.8, 0}};

INSTANTIATE_TEST_SUITE_P(Vacuum, Balance, testing::Combine(testing::ValuesIn(vacuum), testing::ValuesIn(schemes)),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Surrounded, Balance,
                         testing::Combine(testing::ValuesIn(surrounded), testing::ValuesIn(schemes)), name_of);

class Conserved : public testing::TestWithParam<SceneCase> {};

/// Between its two ends a step of energy_momentum takes nothing of cables, points and bodies with quaternions.
TEST_P(Conserved, NothingIsDissipated) {
  const Accounted run(scene_in(GetParam(), conserving, 1, 0.005));
  EXPECT_LE(std::abs(run.now().dissipated), 1e-9 * run.summary.moved);
  EXPECT_EQ(run.now().water, 0);
  EXPECT_EQ(run.now().bed, 0);
}

INSTANTIATE_TEST_SUITE_P(Vacuum, Conserved, testing::Values(vacuum[0], vacuum[2]),
                         [](const auto& item) { return item.param.name; });

namespace {

/// Everything starts smoothly: a jump has no order.
const SceneCase smooth{"smooth", R"(
environment: {gravity: 9.81, fluid: {density: 1025}}
points:
  top:
    position: [0, 0, 0]
    motion: {expression: {x: '0.2*(1-cos(3*t))', y: '0', z: '0.1*(1-cos(4*t))'}}
bodies:
  fish: {mass: 30, inertia: [1, 2, 2], position: [0, 0, -3], volume: 0.02, attachments: {nose: [0, 0, 0.5]},
         drag: {linear: [1, 2, 2, 1, 1, 1], quadratic: [5, 40, 40, 2, 3, 3]}, added_mass: [3, 15, 15, 0.1, 0.5, 0.5]}
cables: {line: {type: wet, from: top, to: fish.nose, elements: 4, length: 2.58}}
)"};

}   // namespace

/// Also where the stage is not the step's middle.
TEST(Accounts, AreOfSecondOrder) {
  using system::Energies;
  const std::map<const char*, double Energies::*> accounts{
      {"work", &Energies::work}, {"damping", &Energies::damping}, {"water", &Energies::water}};
  const Energies exact = Accounted(scene_in(smooth, conserving, 1, 0.005 / 16)).now();
  for (const SchemeCase& by : {conserving, SchemeCase{"generalized_alpha", Scheme::generalized_alpha, 0.6, 0}}) {
    const Energies coarse = Accounted(scene_in(smooth, by, 1, 0.005)).now();
    const Energies fine = Accounted(scene_in(smooth, by, 1, 0.00125)).now();
    for (const auto& [name, account] : accounts) {
      const double off[] = {std::abs(coarse.*account - exact.*account), std::abs(fine.*account - exact.*account)};
      EXPECT_GE(std::log2(off[0] / off[1]) / 2, 1.8) << by.name << " " << name << " " << off[0] << " " << off[1];
    }
  }
}

/// A mass swings on one damped element along a line: m x'' + c x' + k x = 0.
TEST(Accounts, ADashpotTakesWhatTheMassLoses) {
  const double m = 2 + 0.5 / 3, k = 1000, c = 8, x0 = 0.1, end = 0.25;
  scene::Scene scene = scene::read_scene(R"(
environment: {gravity: 0}
cable_types: {dashpot: {mass_per_length: 0.5, axial_stiffness: 1000, axial_damping: 8}}
points: {top: {position: [0, 0, 0], motion: fixed}, bob: {position: [1.1, 0, 0], mass: 2}}
cables: {spring: {type: dashpot, from: top, to: bob, elements: 1, length: 1}}
time: {end: 1, step: 0.1}
)",
                                         "test.yaml");
  scene.time = {0, end, 2.5e-4, Scheme::energy_momentum, 1, 0};
  const Accounted run(scene);
  const double decay = c / (2 * m), w = std::sqrt(k / m - decay * decay);
  const double x = x0 * std::exp(-decay * end) * (std::cos(w * end) + decay / w * std::sin(w * end));
  const double v = -x0 * std::exp(-decay * end) * (w + decay * decay / w) * std::sin(w * end);
  const double lost = 0.5 * k * (x0 * x0 - x * x) - 0.5 * m * v * v;
  // The frequency errs by (w dt)^2/12, as does what is lost per time.
  EXPECT_NEAR(run.now().damping, lost, 1e-4 * lost);
  EXPECT_NEAR(run.now().dissipated, 0, 1e-10 * lost);
}

/// Mass damping alone takes twice its rate of the kinetic energy of what flies freely.
TEST(Accounts, MassDampingSlowsWhatFlies) {
  scene::Scene scene = scene::read_scene(R"(
environment: {gravity: 0}
cable_types: {rope: {mass_per_length: 0.5, axial_stiffness: 1000, rayleigh: {mass: 0.7}}}
points: {a: {position: [0, 0, 0], velocity: [0, 3, 0]}, b: {position: [2, 0, 0], velocity: [0, 3, 0]}}
cables: {line: {type: rope, from: a, to: b, elements: 6}}
time: {end: 1, step: 0.001, scheme: energy_momentum}
)",
                                         "test.yaml");
  const Accounted run(scene);
  const double lost = 0.5 * 0.5 * 2 * 9 * (1 - std::exp(-1.4));
  EXPECT_NEAR(run.now().damping, lost, 1e-6 * lost);
}

/// I w' = -c w, where I includes what turns with the body of the water.  All that the body loses goes to the water.
TEST(Accounts, WaterSlowsATurningBody) {
  const double dry = 2, added = 0.5, c = 1.5, w = 3;
  scene::Scene scene = scene::read_scene(R"(
environment: {gravity: 0, fluid: {density: 1025}}
bodies:
  top: {mass: 1, inertia: [2, 3, 4], position: [0, 0, 0], angular_velocity: [3, 0, 0], drag: {linear: [0, 0, 0, 1.5, 0, 0]},
        added_mass: [0, 0, 0, 0.5, 0, 0]}
time: {end: 1, step: 0.005, scheme: energy_momentum}
)",
                                         "test.yaml");
  const Accounted run(scene);
  const double lost = 0.5 * dry * w * w * (1 - std::exp(-2 * c / (dry + added)));
  EXPECT_NEAR(run.now().water, lost, 1e-4 * lost);
  EXPECT_LE(std::abs(run.now().dissipated), 1e-4 * lost);
}

/// The papers' whip: nothing but the formulas can have brought in its energy.
TEST(Watch, EndsAWhipThatGains) {
  scene::Scene scene = scene::read_scene(R"(
environment: {gravity: 9.81}
cable_types: {steel: {mass_per_length: 0.153036, axial_stiffness: 1039860}}
points: {pin: {position: [0, 0, 0], motion: fixed}, free: {position: [1.713, 0, 0]}}
cables: {c: {type: steel, from: pin, to: free, elements: 24}}
time: {end: 1.2, step: 0.005, scheme: generalized_alpha, spectral_radius: 0.8}
)",
                                         "test.yaml");
  {
    const Accounted run(scene);
    EXPECT_EQ(run.verdict, solve::Verdict::failed);
    EXPECT_TRUE(run.has_gained());
    EXPECT_GT(run.summary.gained, 0.05 * run.summary.moved);
    EXPECT_LE(run.summary.imbalance, 1e-9 * run.summary.moved);
  }
  {
    const Accounted unasked(scene, nullptr, false);
    EXPECT_EQ(unasked.verdict, solve::Verdict::failed);
    EXPECT_TRUE(unasked.has_gained());
    EXPECT_FALSE(unasked.summary.is_accounted);
    EXPECT_GT(unasked.summary.gained, 0.05 * unasked.summary.moved);
  }
  scene.time.scheme = Scheme::energy_momentum;
  scene.time.spectral_radius = 1;
  EXPECT_EQ(Accounted(scene).verdict, solve::Verdict::finished);
  // With these weights this scheme gains, too.
  const Option weight("-off_ts_alpha_gamma", "0.45");
  EXPECT_TRUE(Accounted(scene, "off_").has_gained());
}

/// Looks at no more than 50 of 201 instants find what accounts of every step find, to what Newton's method leaves. What
/// moves is a largest value: between looks, at most 16 steps of a motion that takes 100 steps or more, it may be
/// larger.
TEST(Looks, FindWhatAccountsFind) {
  const SceneCase* const items[] = {&vacuum[0], &vacuum[2]};
  for (const SceneCase* item : items)
    for (const SchemeCase& by : {schemes[1], schemes[2], SchemeCase{"damping", Scheme::energy_momentum, 0, 0}}) {
      const scene::Scene scene = scene_in(*item, by, 1, 0.005);
      const Accounted whole(scene), looked(scene, nullptr, false);
      EXPECT_TRUE(whole.summary.is_accounted);
      ASSERT_TRUE(looked.is_followed && !looked.summary.is_accounted) << item->name << " " << by.name;
      EXPECT_LE(looked.summary.instants, 50) << item->name << " " << by.name;
      EXPECT_GT(std::abs(whole.now().dissipated), 1e-6 * whole.summary.moved) << item->name << " " << by.name;
      EXPECT_NEAR(looked.now().dissipated, whole.now().dissipated, 1e-9 * whole.summary.moved)
          << item->name << " " << by.name;
      EXPECT_LE(looked.summary.moved, whole.summary.moved * (1 + 1e-9)) << item->name << " " << by.name;
      EXPECT_GE(looked.summary.moved, 0.7 * whole.summary.moved) << item->name << " " << by.name;
    }
}

/// Water and damping take energy, too, and a bar's moment brings some in.
TEST(Looks, AreForWhereOnlyTheFormulasTakeEnergy) {
  const SchemeCase &averaged = schemes[2], damping{"damping", Scheme::energy_momentum, 0, 0};
  for (const SceneCase& item : {vacuum[1], vacuum[3], surrounded[0], surrounded[1]}) {
    EXPECT_TRUE(Accounted(scene_in(item, averaged, 0.05, 0.005), nullptr, false).summary.is_accounted) << item.name;
    EXPECT_FALSE(Accounted(scene_in(item, damping, 0.05, 0.005), nullptr, false).is_followed) << item.name;
  }
  std::string text = vacuum[1].text;
  while (text.find("type: damped") != std::string::npos) text.replace(text.find("type: damped"), 12, "type: rope");
  const SceneCase springs{"springs", text.c_str()};
  EXPECT_TRUE(Accounted(scene_in(springs, damping, 0.05, 0.005), nullptr, false).is_followed);
  text.replace(text.find("rigid_link"), 10, "bar");
  const SceneCase bars{"bars", text.c_str()};
  EXPECT_FALSE(Accounted(scene_in(bars, damping, 0.05, 0.005), nullptr, false).is_followed);
}

TEST(Watch, LooksAtWhatMovesAndAtRounding) {
  system::EnergySummary energy;
  energy.moved = 100;
  energy.gained = 4.9;
  EXPECT_FALSE(solve::gains_energy(energy, 0));
  energy.gained = 5.1;
  EXPECT_TRUE(solve::gains_energy(energy, 0));
  EXPECT_FALSE(solve::gains_energy(energy, 0.06));
  energy.gained = std::nan("");
  EXPECT_TRUE(solve::gains_energy(energy, 1));
}

TEST(Watch, IsForSchemesThatMayGain) {
  scene::Time time;
  EXPECT_FALSE(solve::may_gain_energy(time, solve::weights_of(time)));
  solve::AlphaWeights shifted = solve::weights_of(time);
  shifted.alpha_f = 0.55;
  EXPECT_TRUE(solve::may_gain_energy(time, shifted));
  for (const Scheme scheme : {Scheme::generalized_alpha, Scheme::plain}) {
    time.scheme = scheme;
    EXPECT_TRUE(solve::may_gain_energy(time, solve::weights_of(time)));
  }
}

}   // namespace cablenet::test
