#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <ostream>
#include <sstream>

#include "../support/stages.hpp"
#include "cablenet/solve/dynamics.hpp"
#include "cablenet/solve/scheme.hpp"
#include "cablenet/solve/static_forces.hpp"

/// Friction by springs, on cables, points and bodies.
namespace cablenet::test {
namespace {

using scene::Scheme;

const std::string types = R"(
cable_types:
  rope: {mass_per_length: 0.9, axial_stiffness: 2000, diameter: 0.03}
  slack: {mass_per_length: 0.8, axial_stiffness: 1500, diameter: 0.025, tension_only: true}
)";

/// The bed is so soft that all lies in it at its own depth.  What lies 0.2 m deep slips after 9 mm, which is about as
/// far as Stages moves nodes.
const std::string bed = "level: -2, stiffness: 150, damping: 4, friction: 0.3, friction_stiffness: 1000";

/// Cables on the bed, points that touch it as spheres, and bodies of each kind that touch it with spots.
std::string things(const std::string& rotation) {
  const std::string body = "mass: 3, inertia: [0.4, 0.5, 0.6, 0.05, -0.02, 0.03], rotation: " + rotation + ", ";
  return R"(
points:
  a: {position: [0, 0, -2.2], motion: {velocity: [0.3, 0, 0]}}
  b: {position: [4, 1, -2.5], mass: 1, contact_radius: 0.2}
  c: {position: [6, 2, -2.1], mass: 2, volume: 0.02}
  d: {position: [8, 0, -1.95], mass: 1, contact_radius: 0.03}
bodies:
  box: {)" +
         body +
         R"(position: [2, 0, -2], orientation: {roll: 20, pitch: -30, yaw: 50}, angular_velocity: [0.5, -0.7, 0.4],
    attachments: {p: [0.3, 0.1, 0.2], q: [-0.2, 0.3, 0.1]}}
  sledge: {)" +
         body + R"(position: [4, 0.5, -2.1], angular_velocity: [0.1, 0.2, -0.6], attachments: {p: [0.2, 0, 0.1]},
    contact: [[0.3, 0.2, -0.4], [0, 0, 0], [-0.5, 0, -0.3]]}
  ball: {mass: 2, position: [1, 1, -2.2], attachments: {top: [0, 0, 0.4]}, volume: 0.03}
cables:
  first: {type: rope, from: box.p, to: b, elements: 1}
  second: {type: rope, from: a, to: box.q, elements: 3}
  third: {type: slack, from: sledge.p, to: c, elements: 4}
  fourth: {type: rope, from: ball.top, to: box.p, elements: 2}
  fifth: {type: rope, from: c, to: d, elements: 5}
)";
}

network::Network network_of(const std::string& seabed, const std::string& text) {
  const std::string environment = "environment: {gravity: 9.81, seabed: {" + seabed + "}}\n";
  return network::build_network(scene::read_scene(environment + types + text + "time: {end: 1, step: 0.1}\n", "bed"));
}

struct Method {
  std::string name;
  Scheme scheme;
  double radius, dt;
};

struct Case {
  Method method;
  std::string rotation;
  std::string name() const { return method.name + rotation; }
  friend void PrintTo(const Case& item, std::ostream* out) { *out << item.name(); }
};

class StickingTangent : public testing::TestWithParam<Case> {
protected:
  network::Network network_ = network_of(bed, things(GetParam().rotation));
  system::ForceRule rule_{GetParam().method.scheme, 0, elements::Tangent::exact};
};

system::Vector tangent_along(System& system, const Stages& s) {
  system::TangentMatrix tangent = system.assembler.make_tangent();
  system.assembler.tangent(s.stage, s.x, s.v, s.a, {tangent, {s.shift_x, s.shift_v, s.shift_a}});
  tangent.publish();
  return times_direction(system, s, tangent);
}

TEST_P(StickingTangent, IsTheResidualsDerivative) {
  System system(network_, rule_, PETSC_COMM_WORLD);
  Stages s(system, GetParam().method.radius, GetParam().method.dt);
  const double shift_v = s.shift_v, shift_a = s.shift_a;
  system.assembler.begin_step(s.stage.t, s.x0, s.v0);
  for (const auto& [v, a] : {std::pair{shift_v, shift_a}, {shift_v, 0.0}, {0.0, 0.0}}) {
    s.shift_v = v;
    s.shift_a = a;
    const system::Vector expected = slope(system, s, 7e-5 / std::max(shift_v, 70.0));
    EXPECT_LE(relative_difference(tangent_along(system, s), expected), 3e-8) << "shifts " << v << ", " << a;
  }
}

TEST_P(StickingTangent, AllNumbersOfRanksAgree) {
  System together(network_, rule_, PETSC_COMM_WORLD), alone(network_, rule_, PETSC_COMM_SELF);
  std::vector<double> found[2][2];
  for (int i = 0; i < 2; ++i) {
    System& system = i == 0 ? together : alone;
    const Stages s(system, GetParam().method.radius, GetParam().method.dt);
    system.assembler.begin_step(s.stage.t, s.x0, s.v0);
    found[i][0] = everywhere(system, residual_at(system, s, 0));
    found[i][1] = everywhere(system, tangent_along(system, s));
  }
  for (int k = 0; k < 2; ++k) {
    double worst = 0, scale = 0;
    for (std::size_t i = 0; i < found[0][k].size(); ++i) {
      worst = std::max(worst, std::abs(found[0][k][i] - found[1][k][i]));
      scale = std::max(scale, std::abs(found[1][k][i]));
    }
    EXPECT_LE(worst, 1e-12 * scale) << (k == 0 ? "residual" : "tangent");
  }
}

/// Statics measures the pressures, holds them, and lets them follow again.
TEST_P(StickingTangent, OfStaticsIsTheForcesDerivative) {
  System system(network_, rule_, PETSC_COMM_WORLD);
  Stages s(system, 0.5);
  s.shift_v = s.shift_a = 0;
  solve::StaticForces forces(system.assembler, 0, Vector3::Zero());
  const system::Vector r = system.assembler.make_vector(), x = system.assembler.make_vector();
  const auto residual = [&](double step) {
    system::Vector result = system.assembler.make_vector();
    petsc::check(VecWAXPY(x, step, s.direction, s.x));
    EXPECT_TRUE(forces.residual({system::StaticRule::Kind::exact}, x, result, nullptr, {}));
    return result;
  };
  for (const char* how : {"absent", "follows", "held"}) {
    if (how == std::string("follows")) forces.let_stick(s.x0);
    if (how == std::string("held")) forces.hold_friction(s.x0);
    constexpr double h = 1e-6;
    system::Vector expected = residual(h);
    petsc::check(VecAXPY(expected, -1, residual(-h)));
    petsc::check(VecScale(expected, 0.5 / h));
    system::TangentMatrix tangent = system.assembler.make_tangent();
    EXPECT_TRUE(forces.residual({system::StaticRule::Kind::exact}, s.x, r, &tangent, {}));
    EXPECT_LE(relative_difference(times_direction(system, s, tangent), expected), 3e-8) << how;
  }
}

/// All free nodes rise by this way.  No body turns.
void lift(const System& system, double by, Vec x) {
  const partition::LocalNetwork& network = system.assembler.network();
  double* values = nullptr;
  petsc::check(VecGetArray(x, &values));
  for (LocalNode node(0); network.is_owned(node); ++node) values[network.begin[node].value() + 2] += by;
  petsc::check(VecRestoreArray(x, &values));
}

/// What is held has a potential, but for what turns bodies: so this is of bodies that do not turn.  It rubs above the
/// bed, too.
TEST(StickingPotential, IsThatOfTheForces) {
  const std::string text = R"(
points:
  a: {position: [0, 0, -2.2], motion: fixed}
  b: {position: [4, 1, -2.5], mass: 1, contact_radius: 0.2}
bodies: {ball: {mass: 2, position: [8, 1, -2.2], attachments: {top: [0, 0, 0.1]}, volume: 0.03}}
cables: {one: {type: rope, from: a, to: b, elements: 4}, other: {type: rope, from: b, to: ball.top, elements: 4}}
)";
  System system(network_of(bed, text), {Scheme::plain}, PETSC_COMM_WORLD);
  const Stages s(system, 0.5);
  solve::StaticForces forces(system.assembler, 0, Vector3::Zero());
  const system::StaticRule exact{system::StaticRule::Kind::exact};
  const system::Vector r = system.assembler.make_vector(), loads = system.assembler.make_vector();
  const system::Vector x = system.assembler.make_vector();
  forces.let_stick(s.x0);
  forces.hold_friction(s.x0);
  for (const double height : {0.0, 3.0}) {
    lift(system, height, s.x);
    EXPECT_TRUE(forces.residual(exact, s.x, r, nullptr, {}));
    forces.loads(s.x, loads);
    petsc::check(VecAXPY(r, -1, loads));
    PetscReal expected = 0, scale = 0;
    petsc::check(VecDot(r, s.direction, &expected));
    petsc::check(VecNorm(r, NORM_2, &scale));
    constexpr double h = 1e-4;
    double found = 0;
    for (const double sign : {1.0, -1.0}) {
      petsc::check(VecWAXPY(x, sign * h, s.direction, s.x));
      found += sign * forces.potential(exact, x) / (2 * h);
    }
    // The nodes move by 1/200 of the ways to their grips, and the difference errs by the square of that.
    EXPECT_NEAR(found, expected, 3e-5 * scale) << height;
  }
}

/// r with friction less r without, at all nodes.
Field rubbing(const std::string& seabed, const std::string& text, MPI_Comm communicator) {
  System system(network_of(seabed, text), {Scheme::plain}, communicator);
  const Stages s(system, 0.5);
  system.assembler.begin_step(s.stage.t, s.x0, s.v0);
  const system::Vector with = residual_at(system, s, 0), without = system.assembler.make_vector();
  const system::Situation slides{.stage = s.stage, .sticking = system::Sticking::absent};
  EXPECT_TRUE(system.assembler.evaluate(slides, s.x, s.v, s.a, without, nullptr));
  petsc::check(VecAXPY(with, -1, without));
  return system.field(with);
}

/// The tests of tangents say nothing of a scene in which all sticks, or all slips.
TEST(Sticking, SomeNodesStickAndSomeSlipInThatScene) {
  const std::string text = things("quaternion");
  const std::string rough = "level: -2, stiffness: 150, damping: 4, friction: 1e9, friction_stiffness: 1000";
  const Field found = rubbing(bed, text, PETSC_COMM_WORLD), springs = rubbing(rough, text, PETSC_COMM_WORLD);
  int stick = 0, slip = 0;
  for (SceneNode node(0); node.value() < found.size(); ++node) {
    if (springs[node].isZero(0)) continue;
    (found[node] - springs[node]).norm() <= 1e-12 * springs[node].norm() ? ++stick : ++slip;
    EXPECT_LE(found[node].norm(), springs[node].norm() * (1 + 1e-12));
    EXPECT_EQ(found[node].z(), 0);
  }
  EXPECT_GE(stick, 4);
  EXPECT_GE(slip, 4);
}

/// The scene of tests/cases/scenes that resume_test.cpp takes up again after ten steps.
TEST(Sticking, TheSavedSceneSticksAndSlips) {
  std::ostringstream text;
  text << std::ifstream(std::filesystem::path(CABLENET_ROOT) / "tests/cases/scenes/bed_friction.yaml").rdbuf();
  scene::Scene scene = scene::read_scene(text.str(), "bed_friction.yaml");
  scene.time.end = 10 * scene.time.step;
  System system(network::build_network(scene), solve::force_rule_of(scene.time), PETSC_COMM_WORLD);
  Archive before, after;
  const system::Vector x = system.assembler.make_vector(), v = system.assembler.make_vector();
  system.assembler.fill_initial(x, v);
  system.assembler.begin_step(0, x, v);
  system.assembler.archive(before);
  solve::Dynamics dynamics(system.assembler, scene.time, {});
  EXPECT_EQ(dynamics.run({[](const solve::Instant&) {}, [](double, double, const solve::Counts&) {}}),
            solve::Verdict::finished);
  system.assembler.archive(after);
  for (const char* name : {"bed.grips", "bed spots.grips"}) {
    int moved = 0, kept = 0;
    for (std::size_t i = 0; i < before.entries().size(); ++i) {
      if (before.entries()[i].name != name) continue;
      const auto& old = std::get<std::vector<double>>(before.entries()[i].numbers);
      const auto& now = std::get<std::vector<double>>(after.entries()[i].numbers);
      for (std::size_t k = 0; k < now.size(); k += 2)
        (old[k] == now[k] && old[k + 1] == now[k + 1] ? kept : moved) += 1;
    }
    EXPECT_GE(sum_over_ranks(moved), 1) << name;
    EXPECT_GE(sum_over_ranks(kept), 1) << name;
  }
}

const std::vector<Method> methods{{"EnergyMomentum", Scheme::energy_momentum, 1, 0.02},
                                  {"GeneralizedAlpha", Scheme::generalized_alpha, 0.7, 0.02},
                                  {"Plain", Scheme::plain, 0.4, 0.05}};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const Method& method : methods)
    for (const char* rotation : {"quaternion", "euler"}) all.push_back({method, rotation});
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, StickingTangent, testing::ValuesIn(cases()),
                         [](const auto& item) { return item.param.name(); });

}   // namespace
}   // namespace cablenet::test
