#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "cablenet/base/errors.hpp"
#include "cablenet/scene/read.hpp"

namespace cablenet::scene {
namespace {

using environment::Bed;
using environment::Fluid;
using environment::Wave;
using Notes = std::vector<std::string>;

const std::string time = "time: {end: 1, step: 0.1}\n";

/// A scene of one body, which takes three lines.  `environment` begins on line 4.
Scene in_environment(const std::string& environment) {
  return read_scene("bodies:\n  stone: {mass: 2, position: [0, 0, -1], attachments: {}}\n" + time + "environment: {" +
                        environment + "}\n",
                    "water.yaml");
}

Fluid fluid_of(const std::string& keys) { return in_environment("fluid: {density: 1025, " + keys + "}").fluid.value(); }
Bed bed_of(const std::string& keys) { return in_environment("seabed: {" + keys + "}").bed.value(); }

/// A scene in which a rope of this type holds `end`, a point with these keys, and with these lines more.
Scene hanging(const std::string& type, const std::string& end, const std::string& more) {
  return read_scene("cable_types:\n  rope: {" + type + "}\npoints:\n  a: {position: [0, 0, 0], motion: fixed}\n  b: {" +
                        "position: [0, 0, -9]" + end + "}\ncables:\n  c: {type: rope, from: a, to: b, elements: 1}\n" +
                        more,
                    "water.yaml");
}
const std::string rope = "mass_per_length: 1, axial_stiffness: 1";
const std::string water = "environment: {fluid: {density: 1000}}\n";

/// A scene of one body, in line 2, with these keys.
Scene with_body(const std::string& keys, const std::string& environment) {
  return read_scene("bodies:\n  fish: {mass: 2, position: [0, 0, -1], " + keys + "}\n" + time + environment,
                    "water.yaml");
}

/// The notes of a scene, without the note that nothing holds the body.
Notes water_notes(Notes notes) {
  std::erase_if(notes, [](const std::string& note) { return note.find("moves freely") != std::string::npos; });
  return notes;
}
Notes body_notes(const std::string& keys, const std::string& environment) {
  return water_notes(with_body(keys, environment).notes);
}
Notes environment_notes(const std::string& environment) { return water_notes(in_environment(environment).notes); }

TEST(ReadWater, WithoutKeysThereIsNeitherWaterNorBed) {
  const Scene scene = in_environment("gravity: 0");
  EXPECT_FALSE(scene.fluid);
  EXPECT_FALSE(scene.bed);
  EXPECT_EQ(scene.gravity, 0);
}

TEST(ReadWater, FluidAndItsDefaults) {
  const Fluid still = in_environment("fluid: {density: 1025}").fluid.value();
  EXPECT_EQ(still.density, 1025);
  EXPECT_FALSE(still.surface);
  EXPECT_TRUE(still.current.empty());
  EXPECT_TRUE(still.waves.empty());
  EXPECT_FALSE(still.varies());
  EXPECT_EQ(fluid_of("surface: -2.5").surface, -2.5);
  EXPECT_EQ(fluid_of("depth: 30").depth, 30);
  EXPECT_TRUE(fluid_of("waves: []").waves.empty());
}

TEST(ReadWater, Currents) {
  const Fluid uniform = fluid_of("current: {velocity: [0.5, 0.25, 0.125]}");
  ASSERT_EQ(uniform.current.size(), 1u);
  EXPECT_EQ(uniform.current[0].velocity, Vector3(0.5, 0.25, 0.125));
  EXPECT_FALSE(uniform.varies());
  EXPECT_EQ(fluid_of("current: {profile: [[-3, 1, 2, 3]]}").current.at(0).velocity, Vector3(1, 2, 3));
}

TEST(ReadWater, ProfilesAreStoredFromBelow) {
  for (const char* rows :
       {"[-20, 1, 2, 3], [-5, 4, 5, 6], [0, 7, 8, 9]", "[0, 7, 8, 9], [-5, 4, 5, 6], [-20, 1, 2, 3]"}) {
    const Fluid fluid = fluid_of(std::string("current: {profile: [") + rows + "]}");
    ASSERT_EQ(fluid.current.size(), 3u);
    EXPECT_TRUE(fluid.varies());
    EXPECT_EQ(fluid.current[0].z, -20);
    EXPECT_EQ(fluid.current[0].velocity, Vector3(1, 2, 3));
    EXPECT_EQ(fluid.current[1].z, -5);
    EXPECT_EQ(fluid.current[2].velocity, Vector3(7, 8, 9));
  }
}

TEST(ReadWater, WavesAreInRadiansAndHalfTheirHeight) {
  const Scene scene = in_environment(
      "gravity: 9.81, fluid: {density: 1025, surface: 0, depth: 20,\n"
      "  waves: [{height: 2, period: 8, direction: 30, phase: -90}, {height: 0, period: 5}]}");
  ASSERT_EQ(scene.fluid->waves.size(), 2u);
  const Wave& first = scene.fluid->waves[0];
  EXPECT_EQ(first.amplitude, 1);
  EXPECT_DOUBLE_EQ(first.frequency, std::numbers::pi / 4);
  EXPECT_NEAR(first.direction.x(), std::sqrt(0.75), 1e-15);
  EXPECT_NEAR(first.direction.y(), 0.5, 1e-15);
  EXPECT_DOUBLE_EQ(first.phase, -std::numbers::pi / 2);
  const double squared = 9.81 * first.number * std::tanh(20 * first.number);
  EXPECT_NEAR(squared, first.frequency * first.frequency, 1e-12);
  const Wave& second = scene.fluid->waves[1];
  EXPECT_EQ(second.amplitude, 0);
  EXPECT_EQ(second.direction, Eigen::Vector2d(1, 0));
  EXPECT_EQ(second.phase, 0);
}

TEST(ReadWater, BedAndItsDefaults) {
  const Bed bare = bed_of("level: -200, stiffness: 3e6");
  EXPECT_EQ(bare.level, -200);
  EXPECT_EQ(bare.stiffness, 3e6);
  EXPECT_EQ(bare.damping, 0);
  EXPECT_EQ(bare.friction, 0);
  EXPECT_EQ(bare.friction_stiffness, 0);
  EXPECT_EQ(bare.friction_velocity, 0);
  EXPECT_FALSE(bare.sticks());
  const Bed viscous = bed_of("level: 2, stiffness: 1, damping: 3, friction: 0.4, friction_velocity: 0.5");
  EXPECT_EQ(viscous.damping, 3);
  EXPECT_EQ(viscous.friction, 0.4);
  EXPECT_EQ(viscous.friction_velocity, 0.5);
  EXPECT_FALSE(viscous.sticks());
  const Bed sticky = bed_of("level: 2, stiffness: 1, friction: 0.4, friction_stiffness: 7");
  EXPECT_EQ(sticky.friction_stiffness, 7);
  EXPECT_TRUE(sticky.sticks());
}

TEST(ReadWater, AreaAndDiameterEachHaveTheirJob) {
  const auto type = [](const std::string& keys) { return hanging(rope + keys, "", water + time).cable_types.at(0); };
  const CableType both = type(", area: 1e-4, diameter: 0.02");
  EXPECT_EQ(both.area, 1e-4);
  EXPECT_EQ(both.diameter, 0.02);
  EXPECT_DOUBLE_EQ(type(", diameter: 0.02").area, std::numbers::pi * 1e-4);
  EXPECT_DOUBLE_EQ(type(", area: 3.141592653589793e-4").diameter, 0.02);
  const CableType neither = hanging(rope, "", time).cable_types.at(0);
  EXPECT_EQ(neither.area, 0);
  EXPECT_EQ(neither.diameter, 0);
}

TEST(ReadWater, CoefficientsAndTheirDefaults) {
  const CableType full =
      hanging(rope + ", area: 1, normal_drag: 1.2, tangential_drag: 0.01, added_mass: 1", "", water + time)
          .cable_types.at(0);
  EXPECT_EQ(full.normal_drag, 1.2);
  EXPECT_EQ(full.tangential_drag, 0.01);
  EXPECT_EQ(full.added_mass, 1);
  const CableType bare = hanging(rope + ", area: 1", "", water + time).cable_types.at(0);
  EXPECT_EQ(bare.normal_drag + bare.tangential_drag + bare.added_mass, 0);
}

TEST(ReadWater, Points) {
  const Scene scene = hanging(rope + ", area: 1", ", volume: 0.1, drag_area: 0.2, added_mass: 0.3", water + time);
  EXPECT_EQ(scene.points[1].volume, 0.1);
  EXPECT_EQ(scene.points[1].drag_area, 0.2);
  EXPECT_EQ(scene.points[1].added_mass, 0.3);
  EXPECT_EQ(scene.points[0].volume, 0);
  EXPECT_EQ(scene.notes, Notes{});
}

TEST(ReadWater, Bodies) {
  const Body fish = with_body(
                        "inertia: [1, 1, 1], volume: 0.1, center_of_buoyancy: [1, 2, 3],"
                        "drag: {linear: [1, 2, 3, 4, 5, 6]}, added_mass: [6, 5, 4, 3, 2, 1]",
                        water)
                        .bodies.at(0);
  EXPECT_EQ(fish.volume, 0.1);
  EXPECT_EQ(fish.center_of_buoyancy, Vector3(1, 2, 3));
  EXPECT_EQ(fish.linear_drag, (std::array<double, 6>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(fish.quadratic_drag, (std::array<double, 6>{}));
  EXPECT_EQ(fish.added_mass, (std::array<double, 6>{6, 5, 4, 3, 2, 1}));
  EXPECT_EQ(with_body("drag: {quadratic: [0, 0, 7, 0, 0, 0]}", water).bodies.at(0).quadratic_drag[2], 7);
}

TEST(ReadWater, EveryKeyIsCopiedByRepeat) {
  std::ostringstream text;
  text << std::ifstream(std::string(CABLENET_ROOT) + "/tests/cases/valid/everything.yaml").rdbuf();
  const Scene scene = read_scene(text.str(), "everything.yaml");
  EXPECT_EQ(scene.fluid->current.at(2).velocity, Vector3(0.5, 0, 0));
  EXPECT_EQ(scene.fluid->waves.size(), 2u);
  EXPECT_EQ(scene.bed->friction_velocity, 0.02);
  EXPECT_EQ(scene.points.at(6).name, "free[4]");
  EXPECT_EQ(scene.points[6].drag_area, 0.01);
  EXPECT_EQ(scene.points[6].contact_radius, 0.04);
  EXPECT_EQ(scene.bodies.at(3).name, "lead[2]");
  EXPECT_EQ(scene.bodies[3].volume, 4.4e-4);
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_NE(scene.notes[0].find("bodies.lead.attachments.eye"), std::string::npos);
}

TEST(ReadWater, NotesOfKeysOutOfWater) {
  const std::string types = rope + ", normal_drag: 1.2, tangential_drag: 0, added_mass: 1";
  EXPECT_EQ(hanging(types, ", volume: 0.1, drag_area: 0", time).notes,
            (Notes{"water.yaml:2: cable_types.rope.normal_drag: does nothing without environment.fluid",
                   "water.yaml:2: cable_types.rope.added_mass: does nothing without environment.fluid",
                   "water.yaml:5: points.b.volume: does nothing without environment.fluid or environment.seabed"}));
  EXPECT_EQ(body_notes("volume: 1, center_of_buoyancy: [0, 0, 1], drag: {linear: [1, 0, 0, 0, 0, 0]},\n"
                       "    added_mass: [0, 0, 0, 0, 0, 1]",
                       ""),
            (Notes{"water.yaml:2: bodies.fish.volume: does nothing without environment.fluid or environment.seabed",
                   "water.yaml:2: bodies.fish.center_of_buoyancy: does nothing without environment.fluid",
                   "water.yaml:2: bodies.fish.drag: does nothing without environment.fluid",
                   "water.yaml:3: bodies.fish.added_mass: does nothing without environment.fluid"}));
}

TEST(ReadWater, NotesOfKeysWithoutABed) {
  const std::string bed = "environment: {seabed: {level: -20, stiffness: 1}}\n";
  const std::string contact = "contact: [[0, 0, -1]], ", turns = "inertia: [1, 1, 1]";
  EXPECT_EQ(hanging(rope, ", contact_radius: 0.1", time).notes,
            Notes{"water.yaml:5: points.b.contact_radius: does nothing without environment.seabed"});
  EXPECT_EQ(hanging(rope, ", contact_radius: 0", time).notes, Notes{});
  EXPECT_EQ(body_notes(contact + turns, water),
            Notes{"water.yaml:2: bodies.fish.contact: does nothing without environment.seabed"});
  EXPECT_EQ(body_notes("contact: [], " + turns, ""), Notes{});
  EXPECT_EQ(hanging(rope + ", diameter: 0.1", ", contact_radius: 0.1", time + bed).notes, Notes{});
  EXPECT_EQ(body_notes(contact + turns, bed), Notes{});
  EXPECT_EQ(body_notes(contact + "volume: 1", "environment: {fluid: {density: 1}, seabed: {level: -20, stiffness: 1}}"),
            Notes{"water.yaml:2: bodies.fish.contact: does nothing: a body without inertia is a sphere of its volume"});
}

/// What has a volume and no inertia lies on the bed as a sphere.
TEST(ReadWater, NotesOfVolumesOnABed) {
  const std::string bed = "environment: {seabed: {level: -20, stiffness: 1}}\n";
  EXPECT_EQ(hanging(rope + ", diameter: 0.1", ", volume: 0.1", time + bed).notes, Notes{});
  EXPECT_EQ(body_notes("volume: 1", bed), Notes{});
  EXPECT_EQ(
      body_notes("inertia: [1, 1, 1], volume: 1", bed),
      Notes{"water.yaml:2: bodies.fish.volume: does nothing without environment.fluid: the box of the inertia lies "
            "on the bed"});
}

TEST(ReadWater, PointsAndBodiesOnTheBed) {
  const Scene scene = hanging(rope, ", contact_radius: 0.1", time);
  EXPECT_EQ(scene.points[1].contact_radius, 0.1);
  EXPECT_EQ(hanging(rope, "", time).points[1].contact_radius, std::nullopt);
  EXPECT_EQ(with_body("contact: [[1, 2, 3], [4, 5, 6]]", "").bodies.at(0).contact,
            (std::vector<Vector3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(with_body("contact: []", "").bodies.at(0).contact, std::vector<Vector3>{});
  EXPECT_EQ(with_body("inertia: [1, 1, 1]", "").bodies.at(0).contact, std::nullopt);
}

TEST(ReadWater, NotesOfPointMasses) {
  EXPECT_EQ(body_notes("volume: 1, drag: {linear: [1, 0, 0, 0, 0, 0]}, added_mass: [1, 1, 1, 0, 0, 0]", water),
            Notes{});
  EXPECT_EQ(body_notes("volume: 1, center_of_buoyancy: [0, 0, 1],\n"
                       "    drag: {linear: [0, 0, 0, 1, 0, 0], quadratic: [0, 0, 0, 0, 1, 0]},\n"
                       "    added_mass: [0, 0, 0, 0, 0, 1]",
                       water),
            (Notes{"water.yaml:2: bodies.fish.center_of_buoyancy: does nothing: a body without inertia does not turn",
                   "water.yaml:3: bodies.fish.drag.linear: its last three numbers do nothing: a body without inertia "
                   "does not turn",
                   "water.yaml:3: bodies.fish.drag.quadratic: its last three numbers do nothing: a body without "
                   "inertia does not turn",
                   "water.yaml:4: bodies.fish.added_mass: its last three numbers do nothing: a body without inertia "
                   "does not turn"}));
  EXPECT_EQ(body_notes("inertia: [1, 1, 1], center_of_buoyancy: [0, 0, 1]", water),
            Notes{"water.yaml:2: bodies.fish.center_of_buoyancy: does nothing without volume"});
}

TEST(ReadWater, NotesOfTheWavesBed) {
  const std::string waves = "fluid: {density: 1025, surface: 2, depth: 50, waves: [{height: 1, period: 8}]}, ";
  EXPECT_EQ(environment_notes(waves + "seabed: {level: -48.4, stiffness: 1}"), Notes{});
  EXPECT_EQ(environment_notes(waves + "seabed: {level: -49, stiffness: 1}"),
            Notes{"water.yaml:4: environment.fluid.depth: the waves run over a bed at surface - depth = -48 m, cables "
                  "lie on one at environment.seabed.level, -49 m"});
  EXPECT_EQ(environment_notes("fluid: {density: 1, surface: 2, depth: 50}, seabed: {level: -80, stiffness: 1}"),
            Notes{});
}

TEST(ReadWater, NotesOfWavesThatBreak) {
  // In deep water a wave with a period of 4 s is 25 m long.
  const std::string sea = "gravity: 9.81, fluid: {density: 1025, surface: 0, depth: 500, waves: ";
  EXPECT_EQ(environment_notes(sea + "[{height: 3.54, period: 4}]}"), Notes{});
  EXPECT_EQ(environment_notes(sea + "[{height: 1, period: 4}, {height: 3.56, period: 4}]}"),
            Notes{"water.yaml:4: environment.fluid.waves[1]: its height is 0.143 of its length and such waves break at "
                  "0.142: outside the range of linear theory"});
}

}   // namespace
}   // namespace cablenet::scene
