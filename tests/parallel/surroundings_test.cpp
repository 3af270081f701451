#include <gtest/gtest.h>

#include <ostream>

#include "../support/stages.hpp"
#include "cablenet/petsc/queries.hpp"
#include "cablenet/solve/frame_velocity.hpp"
#include "cablenet/solve/static_forces.hpp"

/// These tests compare the tangent of water and bed in the assembled residual with differences, for everything that
/// water and bed act on.
namespace cablenet::test {
namespace {

using scene::Scheme;

const std::string types = R"(
cable_types:
  rope: {mass_per_length: 0.9, axial_stiffness: 2000, diameter: 0.03, normal_drag: 1.2, tangential_drag: 0.3, added_mass: 1.0}
  slack: {mass_per_length: 0.8, axial_stiffness: 1500, diameter: 0.025, tension_only: true, normal_drag: 1.1, added_mass: 0.8}
  damped: {mass_per_length: 1.1, axial_stiffness: 1000, diameter: 0.035, axial_damping: 8, normal_drag: 1.4,
    tangential_drag: 0.5, added_mass: 0.5, rayleigh: {mass: 0.7, stiffness: 2.0e-3}}
)";

struct Named {
  std::string name, text;
};

// Cables, points and bodies lie between z = 0 and -3.2.  The surface of the waves crosses them.  The bed is so soft
// that contact sets in over a range of depths as large as the distance between some nodes.
const std::string bed = "  seabed: {level: -2.2, stiffness: 150, damping: 40, friction: 0.3, friction_velocity: 0.1}\n";
const std::string profile = "current: {profile: [[-2.5, 0.2, -0.4, 0.1], [-1.2, 0.9, 0.3, -0.2], [-0.6, 1.4, 0.1, 0]]}";
const std::string waves =
    "surface: -1.1, depth: 8, waves: [{height: 0.5, period: 2.1, direction: 35, phase: 40}, {height: 0.2, period: 1.3, "
    "direction: -70}]";
const std::vector<Named> settings{
    {"Uniform", "  fluid: {density: 1025, current: {velocity: [0.8, 0.3, -0.2]}}\n"},
    {"Profile", "  fluid: {density: 1025, " + profile + "}\n"},
    {"Surface", "  fluid: {density: 1025, surface: -1.1, current: {velocity: [0.8, 0.3, 0]}}\n"},
    {"Waves", "  fluid: {density: 1025, " + profile + ", " + waves + "}\n"},
    {"Bed", bed},
    {"All", "  fluid: {density: 1025, " + profile + ", " + waves + "}\n" + bed},
};

/// A branched cable that crosses the surface and the bed, with a point of each kind.
const std::string branched = R"(
points:
  tow: {position: [0, 0, 0], motion: {harmonic: {amplitude: [0.1, 0.2, 0.3], period: 0.8, phase: 20}}, mass: 5}
  tail: {position: [8, 1, -2.4], mass: 0.6, force: [0.5, -1, 2], volume: 2.0e-3, drag_area: 0.05, added_mass: 1.5}
  tip: {position: [3, -2, -3], mass: 1.2, drag_area: 0.04}
  buoy: {position: [2, 1, -1], mass: 0.5, volume: 5.0e-2, drag_area: 0.1, added_mass: 3}
  side: {position: [4, 3, -2], motion: fixed}
cables:
  trunk: {type: rope, from: tow, to: tail, elements: 8, length: 8.2}
  branch: {type: damped, from: {cable: trunk, at: 3.1}, to: tip, elements: 4}
  stay: {type: slack, from: {cable: branch, at: 1.5}, to: side, elements: 3, length: 5.5}
  float: {type: slack, from: {cable: trunk, at: 2.05}, to: buoy, elements: 1, length: 0.9}
)";

/// Bodies carry the first end of a cable, its second end, or both ends, on one body or on two.  There is a point mass.
std::string bodies_text(const std::string& extra) {
  const std::string body = "mass: 3, inertia: [0.4, 0.5, 0.6, 0.05, -0.02, 0.03], " + extra +
                           "volume: 0.03, center_of_buoyancy: [0.02, -0.03, 0.1], drag: {linear: [3, 4, 5, 0.3, 0.4, "
                           "0.5], quadratic: [20, 30, 40, 0.6, 0.7, 0.8]}, added_mass: [2, 3, 4, 0.1, 0.2, 0.3], ";
  return R"(
points:
  a: {position: [0, 0, 0], motion: {velocity: [0.3, 0, 0]}}
  b: {position: [4, 1, -3], mass: 1, volume: 1.0e-3, drag_area: 0.02, added_mass: 0.5}
bodies:
  one: {)" +
         body +
         R"(position: [2, 0, -1], orientation: {roll: 20, pitch: -30, yaw: 50}, angular_velocity: [0.5, -0.7, 0.4],
    torque: [0.2, 0.1, -0.3], attachments: {p: [0.3, 0.1, 0.2], q: [-0.2, 0.3, 0.1], r: [0.1, -0.3, -0.2], c: [0, 0, 0]}}
  two: {)" +
         body +
         R"(position: [4, 0.5, -2.1], angular_velocity: [0.1, 0.2, -0.6], attachments: {p: [0.2, 0, 0.1], q: [0, 0.2, -0.3]}}
  bob: {mass: 2, position: [1, 1, -1.2], orientation: {pitch: 40}, attachments: {top: [0, 0, 0.4], middle: [0, 0, 0]},
    volume: 0.02, drag: {linear: [1, 2, 3, 0, 0, 0], quadratic: [9, 8, 7, 0, 0, 0]}, added_mass: [1, 2, 3, 0, 0, 0]}
cables:
  first: {type: rope, from: one.p, to: b, elements: 1}
  second: {type: damped, from: a, to: one.q, elements: 3}
  held: {type: rope, from: a, to: two.p, elements: 1}
  between: {type: slack, from: one.r, to: two.q, elements: 1}
  long: {type: rope, from: two.q, to: one.c, elements: 4}
  handle: {type: rope, from: one.p, to: one.q, elements: 1, length: 0.8}
  loop: {type: damped, from: two.q, to: two.p, elements: 2, length: 0.9}
  string: {type: rope, from: bob.top, to: one.r, elements: 1}
  hung: {type: rope, from: b, to: bob.middle, elements: 2}
)";
}

const std::string link = "coupling: {rigid_link: {axial_stiffness: 3000}}, ";
const std::string bar = "coupling: {bar: {axial_stiffness: 3000}}, ";
const std::vector<Named> things{{"Branched", branched},
                                {"Quaternion", bodies_text("")},
                                {"Euler", bodies_text("rotation: euler, ")},
                                {"LinkedQuaternion", bodies_text(link)},
                                {"LinkedEuler", bodies_text("rotation: euler, " + link)},
                                {"BarredQuaternion", bodies_text(bar)},
                                {"BarredEuler", bodies_text("rotation: euler, " + bar)}};

struct Method {
  std::string name;
  Scheme scheme;
  double radius, dt, xi;
};

const std::vector<Method> methods{{"EnergyMomentum", Scheme::energy_momentum, 1, 0.02, 0.05},
                                  {"GeneralizedAlpha", Scheme::generalized_alpha, 0.7, 0.02, 0},
                                  {"GeneralizedAlphaShort", Scheme::generalized_alpha, 0, 0.002, 0},
                                  {"Plain", Scheme::plain, 0.4, 0.05, 0}};

struct Case {
  Named setting, thing;
  Method method;
  std::string name() const { return setting.name + thing.name + method.name; }
  friend void PrintTo(const Case& c, std::ostream* out) { *out << c.name(); }
};

network::Network network_of(const Named& setting, const Named& thing) {
  const std::string text = "environment:\n" + setting.text + types + thing.text + "time: {end: 1, step: 0.1}\n";
  return network::build_network(scene::read_scene(text, "test.yaml"));
}

/// Gives all free nodes and bodies this velocity; no body turns.
void fill_velocity(const System& system, const Vector3& velocity, Vec v) {
  const partition::LocalNetwork& network = system.assembler.network();
  double* values = nullptr;
  petsc::check(VecSet(v, 0));
  petsc::check(VecGetArray(v, &values));
  for (LocalNode node(0); network.is_owned(node); ++node)
    Eigen::Map<Vector3>(values + network.begin[node].value()) = velocity;
  petsc::check(VecRestoreArray(v, &values));
}

/// The tangent times s.direction, computed with the residual or alone.
system::Vector tangent_along(System& system, const Stages& s, bool with_residual) {
  system::TangentMatrix tangent = system.assembler.make_tangent();
  const system::Vector r = system.assembler.make_vector();
  const system::TangentRequest request{tangent, {s.shift_x, s.shift_v, s.shift_a}};
  if (with_residual)
    system.assembler.residual(s.stage, s.x, s.v, s.a, r, &request);
  else
    system.assembler.tangent(s.stage, s.x, s.v, s.a, request);
  tangent.publish();
  return times_direction(system, s, tangent);
}

class SurroundedTangent : public testing::TestWithParam<Case> {
protected:
  network::Network network_ = network_of(GetParam().setting, GetParam().thing);
  system::ForceRule rule_{GetParam().method.scheme, GetParam().method.xi, elements::Tangent::exact};
};

/// The tangent is exact with inertia and without, because inertia would hide errors, and without velocities too.
TEST_P(SurroundedTangent, IsTheResidualsDerivative) {
  System system(network_, rule_, PETSC_COMM_WORLD);
  Stages s(system, GetParam().method.radius, GetParam().method.dt);
  const double shift_v = s.shift_v, shift_a = s.shift_a;
  system.assembler.begin_step(s.stage.t, s.x0, s.v0);
  for (const auto& [v, a] : {std::pair{shift_v, shift_a}, {shift_v, 0.0}, {0.0, 0.0}, {0.0, shift_a}}) {
    s.shift_v = v;
    s.shift_a = a;
    // Friction reverses within friction_velocity, so h shift_v has to be small compared with it.
    const system::Vector expected = slope(system, s, 7e-5 / std::max(shift_v, 70.0));
    for (const bool with_residual : {true, false})
      EXPECT_LE(relative_difference(tangent_along(system, s, with_residual), expected), 3e-8)
          << "shifts " << v << ", " << a << (with_residual ? ", with the residual" : ", alone");
  }
}

TEST_P(SurroundedTangent, AllNumbersOfRanksAgree) {
  System together(network_, rule_, PETSC_COMM_WORLD), alone(network_, rule_, PETSC_COMM_SELF);
  std::vector<double> found[2][2];
  for (int i = 0; i < 2; ++i) {
    System& system = i == 0 ? together : alone;
    const Stages s(system, GetParam().method.radius, GetParam().method.dt);
    system.assembler.begin_step(s.stage.t, s.x0, s.v0);
    found[i][0] = everywhere(system, residual_at(system, s, 0));
    found[i][1] = everywhere(system, tangent_along(system, s, false));
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

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const Named& setting : settings)
    for (const Named& thing : things)
      for (const Method& method : methods) all.push_back({setting, thing, method});
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, SurroundedTangent, testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name(); });

class Instant : public testing::TestWithParam<std::tuple<std::size_t, std::size_t>> {
protected:
  const Named& setting_ = settings[std::get<0>(GetParam())];
  const Named& thing_ = things[std::get<1>(GetParam())];
  system::ForceRule rule_{Scheme::plain, 0, elements::Tangent::exact};
};

/// The time is not 0, so that waves that are taken at a wrong time show.
TEST_P(Instant, TheMassMatrixIsTheForcesDerivativeByTheAcceleration) {
  System system(network_of(setting_, thing_), rule_, PETSC_COMM_WORLD);
  Stages s(system, 0.5);
  s.stage = {1.3, 0, 0};
  system::TangentMatrix mass = system.assembler.make_tangent();
  EXPECT_FALSE(petsc::is_known_symmetric(mass.matrix())) << "drag and friction are not";
  system.assembler.mass_matrix(s.stage.t, s.x, s.v, mass);
  mass.publish();
  const system::Vector product = system.assembler.make_vector(), force = system.assembler.make_vector();
  petsc::check(MatMult(mass.matrix(), s.a, product));
  system.assembler.force(s.stage.t, s.x, s.v, force);
  system.assembler.begin_step(s.stage.t, s.x, s.v);
  const system::Vector r = residual_at(system, s, 0);
  petsc::check(VecAXPY(r, 1, force));
  EXPECT_LE(relative_difference(product, r), 1e-12);
  s.shift_x = s.shift_v = 0;
  s.shift_a = 1;
  EXPECT_LE(relative_difference(times_direction(system, s, mass), slope(system, s, 1)), 1e-10);
}

/// Nothing of it is damped.
network::Network undamped(network::Network network) {
  for (auto& material : network.materials) material.axial_damping = material.mass_damping = 0;
  if (network.surroundings.bed) network.surroundings.bed->damping = 0;
  return network;
}

/// Statics works in a frame that moves as the prescribed nodes do, with the waves calmed, and without dampers.
TEST_P(Instant, TheStaticTangentIsTheForcesDerivative) {
  Named still = thing_;
  if (const std::size_t law = still.text.find("{harmonic"); law != std::string::npos)
    still.text.replace(law, still.text.find("}}", law) + 2 - law, "fixed");
  const network::Network network = network_of(setting_, still);
  System system(undamped(network), rule_, PETSC_COMM_WORLD), damped(network, rule_, PETSC_COMM_WORLD);
  Stages s(system, 0.5);
  s.stage = {0.4, 0, 0};
  const Vector3 frame = solve::frame_velocity(system.assembler, s.stage.t, 1);
  EXPECT_EQ(frame.x(), std::get<1>(GetParam()) == 0 ? 0 : 0.3);
  solve::StaticForces forces(system.assembler, s.stage.t, frame);
  s.is_calm = true;
  petsc::check(VecSet(s.a, 0));
  fill_velocity(system, frame, s.v);
  system::TangentMatrix tangent = system.assembler.make_tangent();
  const system::Vector r = system.assembler.make_vector(), with_dampers = system.assembler.make_vector();
  solve::StaticForces of_damped(damped.assembler, s.stage.t, frame);
  for (const double shift : {0.0, 7.0}) {
    s.shift_v = shift;
    s.shift_a = shift * shift;
    EXPECT_TRUE(forces.residual({system::StaticRule::Kind::exact}, s.x, r, &tangent, {shift, 0}));
    EXPECT_LE(relative_difference(r, residual_at(system, s, 0)), 1e-12);
    EXPECT_LE(relative_difference(times_direction(system, s, tangent), slope(system, s, 1e-6)), 3e-8) << shift;
    EXPECT_TRUE(of_damped.residual({system::StaticRule::Kind::exact}, s.x, with_dampers, nullptr, {shift, 0}));
    EXPECT_LE(relative_difference(with_dampers, r), 1e-14);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Instant,
                         testing::Combine(testing::Range<std::size_t>(0, 6), testing::Range<std::size_t>(0, 5)),
                         [](const auto& item) {
                           return settings[std::get<0>(item.param)].name + things[std::get<1>(item.param)].name;
                         });

}   // namespace
}   // namespace cablenet::test
