#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cablenet/base/errors.hpp"
#include "cablenet/scene/read.hpp"

namespace cablenet::scene {
namespace {

const std::string time = "time: {end: 1, step: 0.1}\n";

/// A scene of one free body with these keys beside its mass and position.
Scene with_body(const std::string& keys) {
  return read_scene("bodies:\n  fish: {mass: 2, position: [1, 2, 3], " + keys + "}\n" + time, "body.yaml");
}

Body body_of(const std::string& keys) { return with_body(keys).bodies.at(0); }

std::string refusal(const std::string& keys) {
  try {
    with_body(keys);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_near(const Vector3& a, const Vector3& b) { EXPECT_LT((a - b).norm(), 1e-14) << a.transpose(); }

TEST(ReadBodies, EveryKey) {
  const Scene scene = read_scene(
      "bodies:\n  fish:\n    mass: 100\n    inertia: [10, 20, 25, 1, 2, 3]\n    position: [-300, 0, -20]\n"
      "    orientation: {yaw: 90}\n    velocity: [3, 0, 1]\n    angular_velocity: [0.1, 0.2, 0.3]\n"
      "    force: [1, 2, 3]\n    torque: [4, 5, 6]\n    attachments: {top: [0, 0, 0.05], tail: [-1, 0, 0]}\n"
      "    rotation: euler\n    coupling: {rigid_link: {axial_stiffness: 1e9}}\n" +
          time,
      "body.yaml");
  const Body& fish = scene.bodies.at(0);
  EXPECT_EQ(fish.name, "fish");
  EXPECT_EQ(fish.where, "body.yaml:2");
  EXPECT_EQ(fish.mass, 100);
  EXPECT_EQ(fish.inertia.value(), (Matrix3() << 10, -1, -3, -1, 20, -2, -3, -2, 25).finished());
  EXPECT_EQ(fish.position, Vector3(-300, 0, -20));
  expect_near(fish.attitude * Vector3::UnitX(), Vector3::UnitY());
  EXPECT_EQ(fish.velocity, Vector3(3, 0, 1));
  EXPECT_EQ(fish.angular_velocity, Vector3(0.1, 0.2, 0.3));
  EXPECT_EQ(fish.force, Vector3(1, 2, 3));
  EXPECT_EQ(fish.torque, Vector3(4, 5, 6));
  ASSERT_EQ(fish.attachments.size(), 2u);
  EXPECT_EQ(fish.attachments[1].name, "tail");
  EXPECT_EQ(fish.attachments[1].offset, Vector3(-1, 0, 0));
  EXPECT_EQ(fish.rotation, Rotation::euler);
  EXPECT_EQ(fish.link.value().kind, Link::Kind::spring);
  EXPECT_EQ(fish.link->axial_stiffness, 1e9);
}

TEST(ReadBodies, Defaults) {
  const Body fish = read_scene("bodies: {fish: {mass: 2, position: [1, 2, 3]}}\n" + time, "body.yaml").bodies.at(0);
  EXPECT_FALSE(fish.inertia);
  EXPECT_EQ(fish.attitude.coeffs(), Quaternion::Identity().coeffs());
  for (const Vector3& vector : {fish.velocity, fish.angular_velocity, fish.force, fish.torque})
    EXPECT_EQ(vector, Vector3::Zero());
  EXPECT_TRUE(fish.attachments.empty());
  EXPECT_EQ(fish.rotation, Rotation::quaternion);
  EXPECT_FALSE(fish.link);
  EXPECT_FALSE(body_of("coupling: kinematic").link);
  const Body barred = body_of("coupling: {bar: {axial_stiffness: 3e7}}");
  EXPECT_EQ(barred.link.value().kind, Link::Kind::bar);
  EXPECT_EQ(barred.link->axial_stiffness, 3e7);
  EXPECT_EQ(body_of("inertia: [1, 2, 3]").inertia.value(), Matrix3(Vector3(1, 2, 3).asDiagonal()));
  EXPECT_EQ(body_of("angular_velocity: [0, 0, 0], torque: [0, 0, 0]").torque, Vector3::Zero());
}

TEST(ReadBodies, AnglesAreYawThenPitchThenRoll) {
  const double roll = 20 * std::numbers::pi / 180, pitch = -35 * std::numbers::pi / 180,
               yaw = 110 * std::numbers::pi / 180;
  const Matrix3 R = body_of("orientation: {roll: 20, pitch: -35, yaw: 110}").attitude.toRotationMatrix();
  const double cr = std::cos(roll), sr = std::sin(roll), cp = std::cos(pitch), sp = std::sin(pitch), cy = std::cos(yaw),
               sy = std::sin(yaw);
  const Matrix3 expected = (Matrix3() << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,   //
                            sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,                //
                            -sp, cp * sr, cp * cr)
                               .finished();
  EXPECT_LT((R - expected).norm(), 1e-14);
}

TEST(ReadBodies, QuaternionsAreNormalised) {
  const Quaternion half = body_of("orientation: {quaternion: [2, 0, 0, -2]}").attitude;
  EXPECT_NEAR(half.w(), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(half.z(), -std::sqrt(0.5), 1e-15);
  const Quaternion tiny = body_of("orientation: {quaternion: [0, 3e-200, 0, 4e-200]}").attitude;
  EXPECT_NEAR(tiny.x(), 0.6, 1e-15);
  EXPECT_NEAR(tiny.z(), 0.8, 1e-15);
  EXPECT_NEAR(body_of("orientation: {quaternion: [1e200, 0, 0, 0]}").attitude.norm(), 1, 1e-15);
}

TEST(ReadBodies, APlateIsABodyAndMoreIsNone) {
  EXPECT_TRUE(body_of("inertia: [1, 2, 3]").inertia);
  EXPECT_TRUE(body_of("inertia: [0.1, 0.2, 0.3]").inertia);
  EXPECT_TRUE(body_of("inertia: [1, 2, 3.000000001]").inertia);
  EXPECT_NE(refusal("inertia: [1, 2, 3.00001]").find("at most the sum of the other two"), std::string::npos);
  // The inertia is that of a plate with the moments 1, 2, 3, turned by 30 degrees about x.
  EXPECT_TRUE(body_of("inertia: [1, 2.25, 2.75, 0, 0.4330127018922193, 0]").inertia);
  EXPECT_NE(refusal("inertia: [1, 2, 2, 0, 2, 0]").find("positive definite"), std::string::npos);
}

TEST(ReadBodies, EulerAnglesStayOffTheirPole) {
  const std::string euler = "inertia: [1, 1, 1], rotation: euler, orientation: ";
  EXPECT_EQ(refusal(euler + "{pitch: 88.9}"), "accepted");
  EXPECT_EQ(refusal(euler + "{pitch: -120}"), "accepted");
  EXPECT_NE(refusal(euler + "{pitch: 89}").find("a pitch of 89 degrees"), std::string::npos);
  EXPECT_NE(refusal(euler + "{roll: 7, pitch: -90.2, yaw: 3}").find("a pitch of -89.8"), std::string::npos);
  EXPECT_NE(refusal(euler + "{quaternion: [1, 0, 1, 0]}").find("a pitch of 90 degrees"), std::string::npos);
  EXPECT_EQ(refusal("inertia: [1, 1, 1], orientation: {pitch: 90}"), "accepted");
}

TEST(ReadBodies, BodiesAloneAreAScene) {
  const Scene scene = with_body("velocity: [1, 0, 0]");
  EXPECT_EQ(scene.bodies.size(), 1u);
  EXPECT_TRUE(scene.cable_types.empty());
  EXPECT_TRUE(scene.points.empty());
}

TEST(ReadBodies, History) {
  const Scene scene = read_scene("bodies: {a: {mass: 1, position: [0, 0, 0]}, b: {mass: 1, position: [0, 0, 0]}}\n" +
                                     time + "output: {history: [b]}\n",
                                 "body.yaml");
  ASSERT_EQ(scene.output.history.size(), 1u);
  EXPECT_EQ(scene.output.history[0].kind, HistoryKind::body);
  EXPECT_EQ(scene.output.history[0].index, 1);
}

TEST(ReadBodies, CablesNameCopies) {
  const Scene scene = read_scene(
      "cable_types: {rope: {mass_per_length: 1, axial_stiffness: 1}}\n"
      "points: {a: {position: [0, 0, 0], motion: fixed}, b: {position: [9, 0, 0], motion: fixed}}\n"
      "bodies: {fin: {mass: 1, position: [2, 0, -3], attachments: {top: [0, 0, 0], low: [0, 0, -1]}}}\n"
      "cables:\n"
      "  tie: {type: rope, from: \"fin[0].low\", to: \"fin[1].top\", elements: 1}\n"
      "  trunk: {type: rope, from: a, to: b, elements: 9}\n"
      "  drop: {type: rope, from: fin.top, to: {cable: trunk, at: 2}, elements: 1,\n"
      "         repeat: {count: 2, every: 2, offset: [2, 0, 0]}}\n" +
          time,
      "body.yaml");
  EXPECT_EQ(std::get<BodyEnd>(scene.cables[0].from).body, 0);
  EXPECT_EQ(std::get<BodyEnd>(scene.cables[0].from).attachment, 1);
  EXPECT_EQ(std::get<BodyEnd>(scene.cables[0].to).body, 1);
  EXPECT_EQ(std::get<BodyEnd>(scene.cables[3].from).body, 1);
}

/// The notes of a scene with these bodies, a held point a and a cable `trunk` of 9 m from it to fish.top.
std::vector<std::string> notes(const std::string& bodies, const std::string& cables = "") {
  return read_scene(
             "cable_types: {rope: {mass_per_length: 1, axial_stiffness: 1}}\n"
             "points: {a: {position: [0, 0, 0], motion: fixed}}\n"
             "bodies:\n" +
                 bodies + "cables:\n  trunk: {type: rope, from: a, to: fish.top, elements: 9, length: 9}\n" + cables +
                 time,
             "body.yaml")
      .notes;
}

using Notes = std::vector<std::string>;
const std::string fish = "  fish: {mass: 1, position: [9, 0, 0], inertia: [1, 1, 1], attachments: {top: [0, 0, 1]}}\n";

TEST(ReadBodies, NothingToNote) { EXPECT_EQ(notes(fish), Notes{}); }

TEST(ReadBodies, NotesOfAttachments) {
  const std::string two =
      "  fish:\n    mass: 1\n    position: [9, 0, 0]\n    inertia: [1, 1, 1]\n"
      "    attachments:\n      top: [0, 0, 1]\n      tail:\n        [-1, 0, 0]\n";
  EXPECT_EQ(notes(two), Notes{"body.yaml:10: bodies.fish.attachments.tail: no cable ends at this attachment"});
  EXPECT_EQ(notes(two,
                  "  other: {type: rope, from: a, to: fish.top, elements: 1}\n"
                  "  belly: {type: rope, from: fish.top, to: fish.tail, elements: 1}\n"),
            (Notes{"body.yaml:9: bodies.fish.attachments.top: fish.top carries 3 cables: trunk, other, belly; each is "
                   "hinged there by itself",
                   "body.yaml:15: cables.belly: its ends, fish.top and fish.tail, are on one body; end it elsewhere if "
                   "it should hold the body to something"}));
}

TEST(ReadBodies, NotesOfFreeBodies) {
  EXPECT_EQ(notes(fish + "  stone: {mass: 1, position: [0, 0, 0]}\n"),
            Notes{"body.yaml:5: bodies.stone: no cable is attached to it: it moves freely"});
  EXPECT_EQ(notes(fish + "  stone: {mass: 1, position: [0, 0, 0], attachments: {a: [0, 0, 0], b: [0, 0, 1]}}\n"),
            Notes{"body.yaml:5: bodies.stone: no cable is attached to it: it moves freely; to hold it, end a cable at "
                  "stone.a, stone.b"});
}

TEST(ReadBodies, NotesOfPointMassesAndLinks) {
  EXPECT_EQ(
      notes("  fish: {mass: 1, position: [9, 0, 0], attachments: {top: [0, 0, 1]}}\n"),
      Notes{"body.yaml:4: bodies.fish.attachments.top: a body without inertia does not turn: the attachment keeps "
            "its offset in fixed directions; give inertia if it should swing"});
  EXPECT_EQ(notes("  fish: {mass: 1, position: [9, 0, 0], inertia: [1, 1, 1], attachments: {top: [0, 0, 0]},\n"
                  "         coupling: {rigid_link: {axial_stiffness: 1e9}}}\n"),
            Notes{"body.yaml:4: bodies.fish.attachments.top: it is at the centre of gravity and a link needs a length: "
                  "this attachment is coupled kinematically"});
  EXPECT_EQ(notes("  fish: {mass: 1, position: [9, 0, 0], inertia: [1, 1, 1], attachments: {top: [0, 0, 0]},\n"
                  "         coupling: {bar: {axial_stiffness: 1e9}}}\n"),
            Notes{"body.yaml:4: bodies.fish.attachments.top: it is at the centre of gravity and a bar needs a length: "
                  "this attachment is coupled kinematically"});
  EXPECT_EQ(notes("  fish: {mass: 1, position: [9, 0, 0], attachments: {top: [0, 0, 0]}}\n"), Notes{});
}

TEST(ReadBodies, BarsThatTurnABodyHaveANoteOfEnergy) {
  const std::string energy = "output: {energy: true}\n";
  const auto body = [](const std::string& inertia, const std::string& offset, const std::string& coupling) {
    return "  fish: {mass: 1, position: [9, 0, 0], " + inertia + "attachments: {top: " + offset + "}, coupling: {" +
           coupling + ": {axial_stiffness: 1e9}}}\n";
  };
  const std::string turns = "inertia: [1, 1, 1], ", away = "[0, 0, 0.1]";
  EXPECT_EQ(
      notes(body(turns, away, "bar"), energy),
      Notes{"body.yaml:4: bodies.fish: a bar turns the body by r x F, which has no potential: energy.total is not "
            "conserved, but changes by the work of that moment"});
  EXPECT_EQ(notes(body(turns, away, "bar")), Notes{});
  EXPECT_EQ(notes(body(turns, away, "rigid_link"), energy), Notes{});
  for (const std::string& no_moment : {body("", away, "bar"), body(turns, "[0, 0, 0]", "bar")})
    for (const std::string& note : notes(no_moment, energy)) EXPECT_EQ(note.find("potential"), std::string::npos);
}

TEST(ReadBodies, RepeatedBodiesHaveOneNote) {
  const std::string fin = "  fin: {mass: 1, position: [2, 0, -3], attachments: {top: [0, 0, 0], low: [0, 0, -1]}}\n";
  const std::string drop =
      "  drop: {type: rope, from: {cable: trunk, at: 2}, to: fin.top, elements: 1,\n"
      "         repeat: {count: 3, every: 2, offset: [2, 0, 0]}}\n";
  EXPECT_EQ(notes(fish + fin, drop),
            Notes{"body.yaml:5: bodies.fin.attachments.low: no cable ends at this attachment"});
  EXPECT_EQ(
      notes(fish + fin, drop + "  tie: {type: rope, from: \"fin[0].low\", to: \"fin[1].top\", elements: 1}\n"),
      (Notes{"body.yaml:5: bodies.fin.attachments.top: fin[1].top carries 2 cables: drop[1], tie; each is hinged "
             "there by itself",
             "body.yaml:5: bodies.fin.attachments.low: a body without inertia does not turn: the attachment keeps "
             "its offset in fixed directions; give inertia if it should swing"}));
}

}   // namespace
}   // namespace cablenet::scene
