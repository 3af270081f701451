#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "parts.hpp"

namespace cablenet::scene {

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double rounding = 1e-12;   // of the largest moment: below, the matrix cannot be inverted
const char* const inertia_expected = "[Ixx, Iyy, Izz] or [Ixx, Iyy, Izz, Ixy, Iyz, Izx], three or six numbers [kg m2]";

/// A product of inertia is the integral of x y dm, so it stands in the matrix with a minus.
Matrix3 inertia_matrix(const std::vector<double>& numbers) {
  Matrix3 inertia = Vector3(numbers[0], numbers[1], numbers[2]).asDiagonal();
  if (numbers.size() == 3) return inertia;
  inertia(0, 1) = inertia(1, 0) = -numbers[3];
  inertia(1, 2) = inertia(2, 1) = -numbers[4];
  inertia(2, 0) = inertia(0, 2) = -numbers[5];
  return inertia;
}

/// What to write instead of an inertia whose smallest principal moment is not positive.
std::string definiteness_advice(const Vector3& moments, bool has_products) {
  const double largest = moments[2];
  const bool is_zero = std::abs(moments[0]) <= rounding * std::abs(largest);
  if (is_zero && largest == 0) return "Remove inertia: the body is then a point mass.";
  if (is_zero && largest - moments[1] <= 1e-3 * largest)
    return fmt::format("A thin rod has some thickness: give its own axis a small positive moment, like {:.1g}.",
                       1e-3 * largest);
  return has_products
             ? "Correct it: Ixy is the integral of x y dm, the matrix holds -Ixy, and the order is Ixy Iyz Izx."
             : "Correct the values.";
}

void check_inertia(const Value& value, const std::vector<double>& numbers, const Matrix3& inertia) {
  const Vector3 moments = Eigen::SelfAdjointEigenSolver<Matrix3>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  const std::string given = fmt::format("[{}] is not allowed", fmt::join(numbers, ", "));
  const std::string found =
      fmt::format("but its principal moments are {:.6g}, {:.6g} and {:.6g}", moments[0], moments[1], moments[2]);
  if (!(moments[0] > rounding * moments[2]))
    value.fail(fmt::format("{}; expected a positive definite inertia, {}. {}", given, found,
                           definiteness_advice(moments, numbers.size() == 6)));
  if (moments[2] > (moments[0] + moments[1]) * (1 + 1e-9))
    value.fail(
        fmt::format("{}; expected the inertia of some body, whose largest principal moment is at most the sum of the "
                    "other two, {}. Correct the values.",
                    given, found));
}

Matrix3 read_inertia(const Value& value) {
  const std::size_t count = read_list(value, inertia_expected).size();
  if (count != 3 && count != 6) value.refuse(inertia_expected, "Write exactly 3 or 6 numbers.");
  const std::vector<double> numbers = read_numbers(value, count, inertia_expected);
  const Matrix3 inertia = inertia_matrix(numbers);
  check_inertia(value, numbers, inertia);
  return inertia;
}

Quaternion read_quaternion(const Value& value) {
  const std::vector<double> q = read_numbers(value, 4, "[w, x, y, z], four numbers");
  Quaternion quaternion(q[0], q[1], q[2], q[3]);
  const double largest = quaternion.coeffs().cwiseAbs().maxCoeff();
  if (largest == 0)
    value.fail(
        "[0, 0, 0, 0] is not allowed; expected four numbers that are not all zero (they are then scaled to "
        "length 1). Write [1, 0, 0, 0] for body axes along the world's.");
  // The squares of very small and very large numbers are out of range.
  quaternion.coeffs() /= largest;
  return quaternion.normalized();
}

Quaternion read_orientation(const Value& value) {
  const std::string expected = "{roll, pitch, yaw} [deg] or {quaternion: [w, x, y, z]}";
  if (!value.node.IsMap()) value.refuse(expected, "Write one of these.");
  const Section section(value, {"roll", "pitch", "yaw", "quaternion"});
  if (const Value* quaternion = section.find("quaternion")) {
    if (value.node.size() != 1) value.refuse(expected, "Keep one of the two.");
    return read_quaternion(*quaternion);
  }
  const auto turn = [&](const char* key, const Vector3& axis) {
    const Value* angle = section.find(key);
    return Eigen::AngleAxisd(angle != nullptr ? read_angle(*angle) : 0, axis);
  };
  return (turn("yaw", Vector3::UnitZ()) * turn("pitch", Vector3::UnitY()) * turn("roll", Vector3::UnitX()))
      .normalized();
}

std::vector<Attachment> read_attachments(const Value& value, std::vector<Value>& values) {
  std::vector<Attachment> attachments;
  for (const Named& named : read_named(value, "a map from names to [x, y, z] [m]")) {
    attachments.push_back({named.name, read_vector(named.value, "m")});
    values.push_back(named.value);
  }
  return attachments;
}

std::optional<double> read_coupling(const Value& value) {
  const std::string expected = "kinematic or {rigid_link: {axial_stiffness: EA [N]}}";
  if (value.node.IsScalar() && value.node.Scalar() == "kinematic") return std::nullopt;
  if (!value.node.IsMap()) value.refuse(expected, "Write one of these.");
  const Section section(value, {"rigid_link"});
  const Section link(section.require("rigid_link", "{axial_stiffness: EA [N]}"), {"axial_stiffness"});
  return read_number(link.require("axial_stiffness", "a number > 0 [N]"), Sign::positive, "N");
}

/// A turning motion or load, which only a body with inertia has.
Vector3 read_turning(const Value& value, const char* unit, const Body& body) {
  const Vector3 vector = read_vector(value, unit);
  if (!body.inertia && !vector.isZero(0))
    value.fail(
        fmt::format("[{}, {}, {}] is not allowed; expected none, as a body without inertia is a point mass and does "
                    "not turn. Give inertia or remove this.",
                    vector[0], vector[1], vector[2]));
  return vector;
}

/// Roll-pitch-yaw rates grow without bound towards a pitch of +-90 degrees.
void check_pitch(const Value& value, const Body& body) {
  const double sine = -body.attitude.toRotationMatrix()(2, 0);
  const double pitch = std::asin(std::min(std::max(sine, -1.0), 1.0)) / degree;
  if (body.rotation != Rotation::euler || std::abs(pitch) < 89 - 1e-9) return;
  value.fail(
      fmt::format("a pitch of {:.6g} degrees is not allowed with rotation: euler, which is singular at +-90; expected "
                  "one in -89..89. Write rotation: quaternion.",
                  pitch));
}

/// Along the body's three axes, then about them.
std::array<double, 6> read_six(const Value& value, const char* along, const char* about) {
  const std::string expected =
      fmt::format("six numbers >= 0: three along the body's axes [{}], three about them [{}]", along, about);
  read_numbers(value, 6, expected);
  std::array<double, 6> numbers{};
  const std::vector<Value> items = read_list(value, expected);
  for (std::size_t i = 0; i < 6; ++i) numbers[i] = read_number(items[i], Sign::not_negative, i < 3 ? along : about);
  return numbers;
}

void read_water(const Section& section, Body& body) {
  if (const Value* volume = section.find("volume")) body.volume = read_number(*volume, Sign::not_negative, "m3");
  if (const Value* center = section.find("center_of_buoyancy")) body.center_of_buoyancy = read_vector(*center, "m");
  if (const Value* mass = section.find("added_mass")) body.added_mass = read_six(*mass, "kg", "kg m2");
  const Value* value = section.find("drag");
  if (value == nullptr) return;
  if (!value->node.IsMap()) value->refuse("a map of keys: linear, quadratic", "Write drag: {quadratic: [6 numbers]}.");
  const Section drag(*value, {"linear", "quadratic"});
  if (const Value* linear = drag.find("linear")) body.linear_drag = read_six(*linear, "N s/m", "N m s");
  if (const Value* quadratic = drag.find("quadratic")) body.quadratic_drag = read_six(*quadratic, "N s2/m2", "N m s2");
}

BodyDraft read_body(const Named& named) {
  const Section section(
      named.value, {"mass", "inertia", "position", "orientation", "velocity", "angular_velocity", "force", "torque",
                    "attachments", "rotation", "coupling", "volume", "center_of_buoyancy", "drag", "added_mass"});
  Body body;
  std::vector<Value> values;
  body.name = named.name;
  body.where = named.value.where();
  body.mass = read_number(section.require("mass", "a number > 0 [kg]"), Sign::positive, "kg");
  if (const Value* inertia = section.find("inertia")) body.inertia = read_inertia(*inertia);
  body.position = read_vector(section.require("position", "[x, y, z], three numbers [m]"), "m");
  if (const Value* velocity = section.find("velocity")) body.velocity = read_vector(*velocity, "m/s");
  if (const Value* rate = section.find("angular_velocity")) body.angular_velocity = read_turning(*rate, "rad/s", body);
  if (const Value* force = section.find("force")) body.force = read_vector(*force, "N");
  if (const Value* torque = section.find("torque")) body.torque = read_turning(*torque, "N m", body);
  if (const Value* value = section.find("attachments")) body.attachments = read_attachments(*value, values);
  if (const Value* coupling = section.find("coupling")) body.link_stiffness = read_coupling(*coupling);
  if (const Value* rotation = section.find("rotation"))
    body.rotation = read_choice(*rotation, {"quaternion", "euler"}) == 0 ? Rotation::quaternion : Rotation::euler;
  if (const Value* orientation = section.find("orientation")) {
    body.attitude = read_orientation(*orientation);
    check_pitch(*orientation, body);
  }
  read_water(section, body);
  return {{std::move(body), named.value}, std::move(values)};
}

}   // namespace

std::vector<BodyDraft> read_bodies(const Section& top) {
  std::vector<BodyDraft> bodies;
  const Value* value = top.find("bodies");
  if (value == nullptr) return bodies;
  for (const Named& named : read_named(*value, "a map from names to bodies")) bodies.push_back(read_body(named));
  return bodies;
}

}   // namespace cablenet::scene
