#include "cablenet/scene/read.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "cablenet/base/errors.hpp"

namespace cablenet::scene {
namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

const std::filesystem::path everything_path =
    std::filesystem::path(CABLENET_ROOT) / "tests/cases/valid/everything.yaml";

Scene everything() { return read_scene(text_of(everything_path), "everything.yaml"); }

/// "everything.yaml:LINE" of the one line that begins so.
std::string where_everything_has(const std::string& beginning) {
  std::istringstream text(text_of(everything_path));
  std::string line;
  for (int number = 1; std::getline(text, line); ++number)
    if (line.starts_with(beginning)) return "everything.yaml:" + std::to_string(number);
  return "nowhere";
}

const std::string types = "cable_types: {rope: {mass_per_length: 1, axial_stiffness: 1}}\n";
const std::string ends = "points: {a: {position: [0, 0, 0], motion: fixed}, b: {position: [1, 0, 0]}}\n";
const std::string one_cable = "cables: {c: {type: rope, from: a, to: b, elements: 1}}\n";

/// The smallest scene, in which `time` is written as given.
Scene with_time(const std::string& time) {
  return read_scene(types + ends + one_cable + "time: {" + time + "}\n", "small.yaml");
}

std::string message(const std::string& text) {
  try {
    read_scene(text, "bad.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_message(const std::string& text, const std::vector<std::string>& parts) {
  const std::string found = message(text);
  for (const std::string& part : parts) EXPECT_NE(found.find(part), std::string::npos) << found;
  EXPECT_EQ(found.find('\n'), std::string::npos);
}

template <class T>
int index_of(const std::vector<T>& list, const std::string& name) {
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].name == name) return static_cast<int>(i);
  return -1;
}

TEST(Read, CableTypes) {
  const Scene scene = everything();
  ASSERT_EQ(scene.cable_types.size(), 2u);
  const CableType& steel = scene.cable_types[0];
  EXPECT_EQ(steel.name, "steel");
  EXPECT_DOUBLE_EQ(steel.mass_per_length, 7800 * 1.962e-5);
  EXPECT_DOUBLE_EQ(steel.axial_stiffness, 53e9 * 1.962e-5);
  EXPECT_TRUE(steel.tension_only);
  EXPECT_EQ(steel.axial_damping, 12.5);
  EXPECT_EQ(steel.rayleigh_mass, 0.1);
  EXPECT_EQ(steel.rayleigh_stiffness, 1e-4);
  const CableType& rope = scene.cable_types[1];
  EXPECT_EQ(rope.mass_per_length, 0.25);
  EXPECT_EQ(rope.axial_stiffness, 2e4);
  EXPECT_FALSE(rope.tension_only);
  EXPECT_EQ(rope.axial_damping, 0);
}

TEST(Read, DiameterGivesTheArea) {
  const Scene scene = read_scene("cable_types: {rope: {diameter: 2, density: 3, youngs_modulus: 5}}\n" + ends +
                                     one_cable + "time: {end: 1, step: 1}\n",
                                 "small.yaml");
  EXPECT_DOUBLE_EQ(scene.cable_types[0].mass_per_length, 3 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(scene.cable_types[0].axial_stiffness, 5 * std::numbers::pi);
}

TEST(Read, TopLevelKeys) {
  const Scene scene = everything();
  EXPECT_EQ(scene.title, "Every key that a scene may hold");
  EXPECT_EQ(scene.gravity, 9.81);
  EXPECT_EQ(scene.file, "everything.yaml");
  EXPECT_EQ(scene.text.substr(0, 9), "accuracy:");
  EXPECT_EQ(with_time("end: 1, step: 1").gravity, 9.80665);
}

TEST(Read, Points) {
  const Scene scene = everything();
  const Point& pin = scene.points.at(1);
  EXPECT_EQ(pin.name, "pin");
  EXPECT_EQ(pin.where, where_everything_has("  pin: "));
  EXPECT_EQ(pin.mass, 2);
  EXPECT_EQ(pin.force, Vector3(0, 0, -5));
  ASSERT_TRUE(pin.motion);
  EXPECT_EQ(pin.motion->at(9).x, Vector3(300, 0, 0));
}

TEST(Read, Motions) {
  const Scene scene = everything();
  const auto motion = [&](const char* name) {
    return *scene.points.at(static_cast<std::size_t>(index_of(scene.points, name))).motion;
  };
  EXPECT_EQ(motion("tow").at(0.5).x, Vector3(0, 0, 0));
  EXPECT_EQ(motion("tow").at(1.5).x, Vector3(3, 0, 0));
  EXPECT_LT((motion("path").at(2).x - Vector3(1, 10, 0)).norm(), 1e-14);
  EXPECT_LT((motion("swing").at(0).x - Vector3(0, 21, 2)).norm(), 1e-14);
  EXPECT_NEAR(motion("written").at(1).v[0], 5 * std::cos(0.5), 1e-14);
  EXPECT_NEAR(motion("written").at(0).x[2], std::numbers::pi, 1e-14);
}

TEST(Read, RepeatedPointsStandInPlaceOfTheirOriginal) {
  const Scene scene = everything();
  EXPECT_EQ(index_of(scene.points, "free[0]"), 2);
  EXPECT_EQ(index_of(scene.points, "free[4]"), 6);
  EXPECT_EQ(index_of(scene.points, "path"), 7);
  EXPECT_EQ(index_of(scene.points, "free"), -1);
  const Point& last = scene.points[6];
  EXPECT_EQ(last.position, Vector3(240, 0, -20));
  EXPECT_EQ(last.velocity, Vector3(1, 2, 3));
  EXPECT_EQ(last.mass, 0.3);
  EXPECT_EQ(last.force, Vector3(0, 0.5, 0));
  EXPECT_FALSE(last.motion);
  const Point& heaved = scene.points[static_cast<std::size_t>(index_of(scene.points, "heaved[2]"))];
  EXPECT_LT((heaved.motion->at(0.5).x - Vector3(7, 0, -2)).norm(), 1e-14);
}

TEST(Read, RepeatedCablesAreTappedInEqualSteps) {
  const Scene scene = everything();
  const int first = index_of(scene.cables, "branch[0]");
  EXPECT_EQ(first, 1);
  const Cable& last = scene.cables[static_cast<std::size_t>(first) + 4];
  EXPECT_EQ(last.name, "branch[4]");
  EXPECT_EQ(std::get<TapEnd>(last.from).cable, index_of(scene.cables, "trunk"));
  EXPECT_EQ(std::get<TapEnd>(last.from).at, 240);
  EXPECT_EQ(std::get<PointEnd>(last.to).point, index_of(scene.points, "free[4]"));
  EXPECT_EQ(last.shape, Shape::polyline);
  EXPECT_EQ(last.polyline[1], Vector3(241, 0, -10));
  EXPECT_EQ(last.node_velocity[2], Vector3(1, 2, 3));
  const Cable& riser = scene.cables[static_cast<std::size_t>(index_of(scene.cables, "risers[2]"))];
  EXPECT_EQ(std::get<TapEnd>(riser.to).at, 7);
  EXPECT_EQ(std::get<PointEnd>(riser.from).point, index_of(scene.points, "heaved[2]"));
}

TEST(Read, CablesEndAtBodies) {
  const Scene scene = everything();
  const Cable& towline = scene.cables.at(static_cast<std::size_t>(index_of(scene.cables, "towline")));
  EXPECT_EQ(std::get<PointEnd>(towline.from).point, index_of(scene.points, "pin"));
  EXPECT_EQ(std::get<BodyEnd>(towline.to).body, index_of(scene.bodies, "fish"));
  EXPECT_EQ(std::get<BodyEnd>(towline.to).attachment, 0);
  const Cable& sling = scene.cables.at(static_cast<std::size_t>(index_of(scene.cables, "sling")));
  EXPECT_EQ(std::get<BodyEnd>(sling.from).attachment, 1);
  EXPECT_EQ(std::get<BodyEnd>(sling.to).body, index_of(scene.bodies, "buoy"));
}

TEST(Read, RepeatedBodiesStandInPlaceOfTheirOriginal) {
  const Scene scene = everything();
  ASSERT_EQ(scene.bodies.size(), 5u);
  EXPECT_EQ(scene.bodies[1].name, "lead[0]");
  EXPECT_EQ(scene.bodies[4].name, "buoy");
  const Body& last = scene.bodies[3];
  EXPECT_EQ(last.name, "lead[2]");
  EXPECT_EQ(last.position, Vector3(40, 0, -10.1));
  EXPECT_EQ(last.velocity, Vector3(1, 0, 0));
  EXPECT_EQ(last.mass, 5);
  EXPECT_EQ(last.attachments.at(0).offset, Vector3(0, 0, 0.1));
  const Cable& dropper = scene.cables.at(static_cast<std::size_t>(index_of(scene.cables, "droppers[2]")));
  EXPECT_EQ(std::get<TapEnd>(dropper.from).at, 40);
  EXPECT_EQ(std::get<BodyEnd>(dropper.to).body, 3);
}

TEST(Read, ACableMayNameCopiesAndComeBeforeItsHost) {
  const Scene scene = everything();
  const Cable& hanger = scene.cables[0];
  EXPECT_EQ(hanger.where, where_everything_has("  hanger:"));
  EXPECT_EQ(std::get<TapEnd>(hanger.from).cable, index_of(scene.cables, "branch[2]"));
  EXPECT_EQ(std::get<PointEnd>(hanger.to).point, index_of(scene.points, "free[0]"));
  EXPECT_FALSE(hanger.length);
  EXPECT_EQ(hanger.type, 1);
  EXPECT_EQ(hanger.shape, Shape::straight);
}

TEST(Read, NetsAndCablesOnThem) {
  const Scene scene = everything();
  ASSERT_EQ(scene.nets.size(), 1u);
  const Net& panel = scene.nets[0];
  EXPECT_EQ(panel.corners[2], Vector3(10, 40, -5));
  EXPECT_EQ(panel.meshes, (std::array<int, 2>{4, 2}));
  EXPECT_EQ(panel.slack, 1.02);
  EXPECT_EQ(panel.fixed, (std::vector<Edge>{Edge::top, Edge::left}));
  const Cable& link = scene.cables.back();
  EXPECT_EQ(std::get<NetEnd>(link.to).node, (std::array<int, 2>{4, 2}));
  EXPECT_EQ(scene.cables[scene.cables.size() - 2].shape, Shape::catenary);
}

TEST(Read, TimeAndItsDefaults) {
  const Time time = everything().time;
  EXPECT_EQ(time.start, 0.5);
  EXPECT_EQ(time.end, 3.5);
  EXPECT_EQ(time.step, 2e-3);
  EXPECT_EQ(time.scheme, Scheme::generalized_alpha);
  EXPECT_EQ(time.spectral_radius, 0.6);
  EXPECT_EQ(with_time("end: 1, step: 1").time.start, 0);
}

TEST(Read, SchemeDefaults) {
  const Time none = with_time("end: 1, step: 0.1").time;
  EXPECT_EQ(none.scheme, Scheme::energy_momentum);
  EXPECT_EQ(none.spectral_radius, 1);
  EXPECT_EQ(none.axial_dissipation, 0.0053);
  const Time named = with_time("end: 1, step: 0.1, scheme: energy_momentum").time;
  EXPECT_EQ(named.scheme, Scheme::energy_momentum);
  EXPECT_EQ(named.spectral_radius, 1);
  EXPECT_EQ(named.axial_dissipation, 0);
  for (const char* scheme : {"", ", scheme: energy_momentum"}) {
    const Time radius = with_time(std::string("end: 1, step: 0.1, spectral_radius: 0.3") + scheme).time;
    EXPECT_EQ(radius.scheme, Scheme::energy_momentum);
    EXPECT_EQ(radius.spectral_radius, 0.3);
    EXPECT_EQ(radius.axial_dissipation, 0.0053);
  }
  EXPECT_EQ(with_time("end: 1, step: 0.1, spectral_radius: 1").time.axial_dissipation, 0);
  EXPECT_EQ(with_time("end: 1, step: 0.1, scheme: generalized_alpha").time.spectral_radius, 0.8);
  const Time plain = with_time("end: 1, step: 0.1, scheme: plain").time;
  EXPECT_EQ(plain.scheme, Scheme::plain);
  EXPECT_EQ(plain.spectral_radius, 0.8);
}

TEST(Read, AnAdaptiveStepMayStartSmall) {
  EXPECT_EQ(everything().time.tolerance, 1e-5);
  EXPECT_FALSE(with_time("end: 1, step: 1").time.tolerance);
  EXPECT_EQ(with_time("end: 1000, step: 1e-12, adaptive: {tolerance: 1e-3}").time.tolerance, 1e-3);
}

TEST(Read, InitialShapes) {
  const std::string scene = types + ends + one_cable + "time: {start: 2, end: 3, step: 1}\n";
  for (const char* initial : {"", "initial: rest\n"}) {
    const Scene rest = read_scene(scene + initial, "small.yaml");
    EXPECT_FALSE(rest.is_static);
    EXPECT_FALSE(rest.starts_static);
  }
  const Scene from_equilibrium = read_scene(scene + "initial: static\n", "small.yaml");
  EXPECT_FALSE(from_equilibrium.is_static);
  EXPECT_TRUE(from_equilibrium.starts_static);
  EXPECT_EQ(from_equilibrium.time.start, 2);
}

TEST(Read, WithoutTimeASceneIsStatic) {
  const std::string motions =
      "points:\n  a: {motion: {waypoints: [[-1, 0, 0, 0], [3, 4, 0, 0]]}}\n"
      "  b: {position: [2, 0, 0], motion: {expression: {x: sqrt(1+t)}}}\n"
      "output: {interval: 0.1, history: [a], energy: true}\n";
  for (const char* initial : {"", "initial: static\n"}) {
    const Scene scene = read_scene(types + motions + one_cable + initial, "small.yaml");
    EXPECT_TRUE(scene.is_static);
    EXPECT_TRUE(scene.starts_static);
    EXPECT_EQ(scene.time.start, 0);
    EXPECT_EQ(scene.time.end, 0);
    EXPECT_LT((scene.points[0].position - Vector3(1, 0, 0)).norm(), 1e-14);
    EXPECT_EQ(scene.points[1].motion->at(0).x, Vector3(3, 0, 0));
    EXPECT_TRUE(scene.notes.empty());
  }
}

TEST(Read, WithoutTimeADrawnVelocityIsNotedOnce) {
  const auto notes = [](const std::string& bodies, const std::string& more) {
    return read_scene(types + ends + one_cable + "bodies:\n" + bodies + more, "small.yaml").notes;
  };
  const std::string attached = "  stone: {mass: 1, position: [0, 0, -1], attachments: {top: [0, 0, 0]}VELOCITY}\n";
  const std::string moving = std::string(attached).replace(attached.find("VELOCITY"), 8, ", velocity: [1, 0, 0]");
  const auto found = notes(moving + "  other: {mass: 1, position: [0, 0, 0], velocity: [0, 1, 0]}\n", "");
  EXPECT_EQ(std::count(found.begin(), found.end(),
                       "small.yaml:5: bodies.stone: a drawn velocity does nothing in a scene without time: its "
                       "equilibrium is solved"),
            1);
  EXPECT_EQ(found.size(), 3u);
  EXPECT_EQ(notes(moving, "time: {end: 1, step: 1}\n").size(), 1u);
}

TEST(Read, OutputAndItsDefaults) {
  const Scene scene = everything();
  EXPECT_EQ(scene.output.interval, 1e-2);
  EXPECT_TRUE(scene.output.energy);
  ASSERT_EQ(scene.output.history.size(), 12u);
  EXPECT_EQ(scene.output.history[0].kind, HistoryKind::point);
  EXPECT_EQ(scene.output.history[4].index, index_of(scene.points, "free[4]"));
  EXPECT_EQ(scene.output.history[5].kind, HistoryKind::cable);
  EXPECT_EQ(scene.output.history[5].index, index_of(scene.cables, "branch[3]"));
  EXPECT_EQ(scene.output.history[10].kind, HistoryKind::body);
  EXPECT_EQ(scene.output.history[10].index, index_of(scene.bodies, "lead[2]"));
  EXPECT_EQ(scene.output.history[11].index, index_of(scene.bodies, "fish"));
  const Output none = with_time("end: 4, step: 0.1").output;
  EXPECT_EQ(none.interval, 0.04);
  EXPECT_TRUE(none.history.empty());
  EXPECT_FALSE(none.energy);
}

TEST(Read, ATapWithinRoundingOfTheEndIsAtTheEnd) {
  const Scene scene = read_scene(
      types +
          "points: {a: {position: [0, 0, 0], motion: fixed}, b: {position: [1, 0, 0]}, c: {position: [0, 0, -1]}}\n"
          "cables:\n"
          "  trunk: {type: rope, from: a, to: b, length: 0.3, elements: 3}\n"
          "  drop: {type: rope, from: {cable: trunk, at: 0}, to: c, elements: 1,\n"
          "         repeat: {count: 4, every: 0.1, offset: [1, 0, 0]}}\n"
          "time: {end: 1, step: 1}\n",
      "small.yaml");
  EXPECT_EQ(std::get<TapEnd>(scene.cables[4].from).at, 0.3);
}

TEST(Read, MessagesNamePlaceValueAndRemedy) {
  expect_message("cable_types:\n  steel:\n    area: -1\ntime: {end: 1, step: 1}\n",
                 {"bad.yaml:3: cable_types.steel.area: -1 is not allowed; expected a number > 0 [m2]."});
  expect_message("", {"bad.yaml:1: nothing is not allowed; expected a scene"});
  expect_message("a: [1\nb: 2\n", {"bad.yaml:2: the file is no valid YAML"});
  expect_message("tme: {}\n", {"bad.yaml:1: tme: unknown key", "Did you mean time?"});
}

TEST(Read, LongListsAreReadQuickly) {
  std::ostringstream text;
  text << types << "time: {end: 1, step: 1}\npoints:\n  p0: {position: [0, 0, 0], motion: fixed}\n";
  const int count = 5000;
  for (int i = 1; i <= count; ++i) text << "  p" << i << ": {position: [" << i << ", 0, 0]}\n";
  text << "cables:\n";
  for (int i = 1; i <= count; ++i)
    text << "  c" << i << ": {type: rope, from: p" << i - 1 << ", to: p" << i << ", elements: 1}\n";
  const Scene scene = read_scene(text.str(), "long.yaml");
  EXPECT_EQ(scene.cables.size(), static_cast<std::size_t>(count));
}

}   // namespace
}   // namespace cablenet::scene
