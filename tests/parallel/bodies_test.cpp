#include <gtest/gtest.h>

#include <ostream>

#include "../support/stages.hpp"
#include "cablenet/bodies/rigid_body.hpp"

/// These tests compare the tangent of bodies in the assembled residual with differences, for every way in which an
/// element can end on a body.
namespace cablenet::test {
namespace {

using scene::Scheme;

/// Bodies carry the first end of a cable, its second end, or both ends, on two bodies or on one.  There are cables of
/// one element and of several, and there is a point mass.
std::string scene_text(const std::string& extra, const std::string& rope) {
  const std::string body = "mass: 3, inertia: [0.4, 0.5, 0.6, 0.05, -0.02, 0.03], " + extra;
  return "points: {a: {position: [0, 0, 0], motion: {velocity: [0.3, 0, 0]}}, b: {position: [4, 1, -3], mass: 1}}\n"
         "bodies:\n"
         "  one: {" +
         body +
         "position: [2, 0, -1], orientation: {roll: 20, pitch: -30, yaw: 50}, angular_velocity: "
         "[0.5, -0.7, 0.4], torque: [0.2, 0.1, -0.3], force: [0, 1, 0], attachments: {p: [0.3, 0.1, 0.2], q: [-0.2, "
         "0.3, "
         "0.1], r: [0.1, -0.3, -0.2], c: [0, 0, 0]}}\n"
         "  two: {" +
         body +
         "position: [4, 0.5, -1.5], angular_velocity: [0.1, 0.2, -0.6], attachments: {p: [0.2, 0, "
         "0.1], q: [0, 0.2, -0.3]}}\n"
         "  bob: {mass: 2, " +
         extra +
         "position: [1, 1, -3], orientation: {pitch: 40}, attachments: {top: [0, 0, 0.4], middle: "
         "[0, 0, 0]}}\n"
         "cables:\n"
         "  first: {type: " +
         rope +
         ", from: one.p, to: b, elements: 1}\n"
         "  second: {type: " +
         rope +
         ", from: a, to: one.q, elements: 3}\n"
         "  held: {type: " +
         rope +
         ", from: a, to: two.p, elements: 1}\n"
         "  between: {type: " +
         rope +
         ", from: one.r, to: two.q, elements: 1}\n"
         "  long: {type: " +
         rope +
         ", from: two.q, to: one.c, elements: 4}\n"
         "  handle: {type: " +
         rope +
         ", from: one.p, to: one.q, elements: 1, length: 0.8}\n"
         "  loop: {type: " +
         rope +
         ", from: two.q, to: two.p, elements: 2, length: 0.9}\n"
         "  string: {type: " +
         rope +
         ", from: bob.top, to: one.r, elements: 1}\n"
         "  hung: {type: " +
         rope + ", from: b, to: bob.middle, elements: 2}\n";
}

struct Case {
  std::string name, extra, rope;
  Scheme scheme;
  double radius, xi;
  friend void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }
};

class BodyTangent : public testing::TestWithParam<Case> {};

TEST_P(BodyTangent, IsTheResidualsDerivative) {
  const Case& c = GetParam();
  System system(network_of(scene_text(c.extra, c.rope)), {c.scheme, c.xi, elements::Tangent::exact}, PETSC_COMM_WORLD);
  const Stages s(system, c.radius);
  system.assembler.begin_step(s.stage.t, s.x0, s.v0);
  system::TangentMatrix tangent = system.assembler.make_tangent();
  const system::Vector r = system.assembler.make_vector(), expected = slope(system, s, 1e-5);
  const system::TangentRequest request{tangent, {1, s.shift_v, s.shift_a}};
  for (const bool together : {true, false}) {
    if (together)
      system.assembler.residual(s.stage, s.x, s.v, s.a, r, &request);
    else
      system.assembler.tangent(s.stage, s.x, s.v, s.a, request);
    tangent.publish();
    EXPECT_LE(relative_difference(times_direction(system, s, tangent), expected), 3e-8)
        << (together ? "with the residual" : "alone");
  }
}

std::vector<Case> cases() {
  std::vector<Case> all;
  const std::pair<std::string, std::string> ways[] = {
      {"Quaternion", ""},
      {"Euler", "rotation: euler, "},
      {"LinkedQuaternion", "coupling: {rigid_link: {axial_stiffness: 3000}}, "},
      {"LinkedEuler", "rotation: euler, coupling: {rigid_link: {axial_stiffness: 3000}}, "},
      {"BarredQuaternion", "coupling: {bar: {axial_stiffness: 3000}}, "},
      {"BarredEuler", "rotation: euler, coupling: {bar: {axial_stiffness: 3000}}, "}};
  for (const auto& [name, extra] : ways)
    for (const std::string rope : {"rope", "damped", "slack"}) {
      all.push_back({name + "EnergyMomentum_" + rope, extra, rope, Scheme::energy_momentum, 1, 0.05});
      all.push_back({name + "GeneralizedAlpha_" + rope, extra, rope, Scheme::generalized_alpha, 0.7, 0});
      all.push_back({name + "Plain_" + rope, extra, rope, Scheme::plain, 0.4, 0});
    }
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, BodyTangent, testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name; });

}   // namespace
}   // namespace cablenet::test
