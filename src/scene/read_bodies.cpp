#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "parts.hpp"
#include "rows.hpp"

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

Kind<Matrix3> inertia() {
  const NumberForm moment{"kg m2", any_number};
  const std::vector<NumberForm> three(3, moment), six(6, moment);
  return {either_form(inertia_expected,
                      {tuple_form("[Ixx, Iyy, Izz]", three), tuple_form("[Ixx, Iyy, Izz, Ixy, Iyz, Izx]", six)}),
          read_inertia, nullptr};
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

struct OrientationKeys {
  double roll = 0, pitch = 0, yaw = 0;
  std::optional<Quaternion> quaternion;
};
const NumberForm part{"", any_number};
const std::string orientation_expected = "{roll, pitch, yaw} [deg] or {quaternion: [w, x, y, z]}";
const Table<OrientationKeys> orientation_table(
    "The attitude of a body: its axes, along the world's at first, are turned by yaw, then pitch, then roll.",
    {{"roll", angle(), standard, "The turn about the body's x axis.", &OrientationKeys::roll},
     {"pitch", angle(), standard, "The turn about the body's y axis.", &OrientationKeys::pitch},
     {"yaw", angle(), standard, "The turn about the world's z axis.", &OrientationKeys::yaw},
     {"quaternion",
      Kind<Quaternion>{tuple_form("[w, x, y, z], four numbers", {part, part, part, part}), read_quaternion, nullptr},
      absent("roll, pitch and yaw say it"), "The attitude as a quaternion instead; it is scaled to length 1.",
      &OrientationKeys::quaternion}},
    Holds::any_keys, orientation_expected);

Quaternion read_orientation(const Value& value) {
  if (!value.node.IsMap()) value.refuse(orientation_expected, "Write one of these.");
  OrientationKeys keys;
  read_rows(value, orientation_table, keys);
  if (keys.quaternion && value.node.size() != 1) value.refuse(orientation_expected, "Keep one of the two.");
  if (keys.quaternion) return *keys.quaternion;
  const auto turn = [](double angle, const Vector3& axis) { return Eigen::AngleAxisd(angle, axis); };
  return (turn(keys.yaw, Vector3::UnitZ()) * turn(keys.pitch, Vector3::UnitY()) * turn(keys.roll, Vector3::UnitX()))
      .normalized();
}

/// The values tell where an attachment stands in the file, for notes.
struct BodyKeys : Body {
  std::vector<Value> attachment_values;
};

void read_attachments(BodyKeys& body, const Value& value) {
  for (const Named& named : read_named(value, "a map from names to [x, y, z] [m]")) {
    body.attachments.push_back({named.name, read_vector(named.value, "m")});
    body.attachment_values.push_back(named.value);
  }
}

struct LinkKeys {
  double axial_stiffness = 0;
};
const Table<LinkKeys> spring_table(
    "A spring between a cable's end and its attachment.",
    {{"axial_stiffness", number("N", above(0)), required,
      "The link's EA; its stiffness is EA over the attachment's distance from the centre of gravity.",
      &LinkKeys::axial_stiffness}});
const Table<LinkKeys> bar_table(
    "A bar without mass between a cable's end and the body's centre of gravity, pinned at both.",
    {{"axial_stiffness", number("N", above(0)), required,
      "The bar's EA; its unstretched length is the attachment's distance from the centre of gravity.",
      &LinkKeys::axial_stiffness}});

struct CouplingKeys {
  LinkKeys rigid_link, bar;
};
const std::string coupling_expected =
    "kinematic, {rigid_link: {axial_stiffness: EA [N]}} or {bar: {axial_stiffness: EA [N]}}";
const Table<CouplingKeys> coupling_table(
    "How cables are fastened to a body.",
    {{"rigid_link", section(spring_table), absent(""), "A cable's end is a node of its own that a stiff spring holds.",
      &CouplingKeys::rigid_link},
     {"bar", section(bar_table), absent(""),
      "A cable's end is a node of its own that a bar ties to the centre of gravity; the bar's force F turns the body "
      "by r x F, where r is the attachment's lever.",
      &CouplingKeys::bar}},
    Holds::one_key, coupling_expected);

std::optional<Link> read_coupling(const Value& value) {
  if (value.node.IsScalar() && value.node.Scalar() == "kinematic") return std::nullopt;
  if (!value.node.IsMap()) value.refuse(coupling_expected, "Write one of these.");
  CouplingKeys keys;
  read_rows(value, coupling_table, keys);
  if (keys.bar.axial_stiffness > 0) return Link{Link::Kind::bar, keys.bar.axial_stiffness};
  return Link{Link::Kind::spring, keys.rigid_link.axial_stiffness};
}

const Table<Body> drag_table("The drag of a body along and about its axes, at the centre of gravity.",
                             {{"linear", six_numbers("N s/m", "N m s"), standard, "The drag per velocity.",
                               &Body::linear_drag},
                              {"quadratic", six_numbers("N s2/m2", "N m s2"), standard,
                               "The drag per velocity squared.", &Body::quadratic_drag}});

void read_drag(Body& body, const Value& value) {
  if (!value.node.IsMap()) value.refuse(drag_table.expected, "Write drag: {quadratic: [6 numbers]}.");
  read_rows(value, drag_table, body);
}

const std::string spots_expected = "a list of rows [x, y, z] [m]";
Kind<std::vector<Vector3>> spots() {
  const auto read = [](const Value& value) { return read_vectors(value, 0, "m"); };
  return {list_form(spots_expected, vector("m").form), read, nullptr};
}

const Table<BodyKeys> body_table(
    "A rigid body.",
    {{"mass", number("kg", above(0)), required, "The mass.", &BodyKeys::mass},
     {"inertia", inertia(), absent("a point mass, which does not turn"),
      "The moments and products of inertia about the centre of gravity in body axes; Ixy is the integral of x y dm.",
      &BodyKeys::inertia},
     {"position", vector("m"), required, "Where the centre of gravity is drawn.", &BodyKeys::position},
     {"orientation", later(section_form(orientation_table)), absent("body axes along the world's"),
      "The drawn attitude.", [](Body& body, const Value& value) { body.attitude = read_orientation(value); }},
     {"velocity", vector("m/s"), standard, "The velocity at the start, in the world's axes.", &BodyKeys::velocity},
     {"angular_velocity", vector("rad/s"), standard, "The angular velocity at the start, in body axes.",
      &BodyKeys::angular_velocity},
     {"force", vector("N"), standard, "A constant force at the centre of gravity, in the world's axes.",
      &BodyKeys::force},
     {"torque", vector("N m"), standard, "A constant torque, in body axes.", &BodyKeys::torque},
     {"attachments", later(map_form("a map from names to [x, y, z] [m]", vector("m").form)), absent("there are none"),
      "Where cables may be fastened, from the centre of gravity in body axes.", read_attachments},
     {"rotation", choice<Rotation>(), standard, "How the attitude is described to the solver.", &BodyKeys::rotation},
     {"coupling", later(either_form(coupling_expected, {word_form({"kinematic"}), section_form(coupling_table)})),
      absent("kinematic: a cable's end is the attachment"), "How cables are fastened to the body.",
      [](Body& body, const Value& value) { body.link = read_coupling(value); }},
     Row<BodyKeys>("contact", spots(),
                   absent("the corners of the box that has the body's inertia; without inertia a sphere of its volume"),
                   "Where the body touches the bed, from the centre of gravity in body axes; []: it does not.",
                   &BodyKeys::contact)
         .on_bed(),
     Row<BodyKeys>("volume", number("m3", at_least(0)), standard, "The water that the body displaces.",
                   &BodyKeys::volume)
         .in_fluid_or_on_bed(),
     Row<BodyKeys>("center_of_buoyancy", vector("m"), standard,
                   "Where buoyancy acts, from the centre of gravity in body axes.", &BodyKeys::center_of_buoyancy)
         .in_fluid(),
     Row<BodyKeys>("drag", later(section_form(drag_table)), absent("there is none"), "The drag of the body.", read_drag)
         .in_fluid(),
     Row<BodyKeys>("added_mass", six_numbers("kg", "kg m2"), standard,
                   "The added mass and inertia along and about the body's axes.", &BodyKeys::added_mass)
         .in_fluid()});

/// A turning motion or load, which only a body with inertia has.
void check_turning(const Value* value, const Vector3& vector, const Body& body) {
  if (value == nullptr || body.inertia || vector.isZero(0)) return;
  value->fail(
      fmt::format("[{}, {}, {}] is not allowed; expected none, as a body without inertia is a point mass and does "
                  "not turn. Give inertia or remove this.",
                  vector[0], vector[1], vector[2]));
}

/// Roll-pitch-yaw rates grow without bound towards a pitch of +-90 degrees.
void check_pitch(const Value* value, const Body& body) {
  const double sine = -body.attitude.toRotationMatrix()(2, 0);
  const double pitch = std::asin(std::min(std::max(sine, -1.0), 1.0)) / degree;
  if (value == nullptr || body.rotation != Rotation::euler || std::abs(pitch) < 89 - 1e-9) return;
  value->fail(
      fmt::format("a pitch of {:.6g} degrees is not allowed with rotation: euler, which is singular at +-90; expected "
                  "one in -89..89. Write rotation: quaternion.",
                  pitch));
}

BodyDraft read_body(const Named& named) {
  BodyKeys body;
  const Section section = read_rows(named.value, body_table, body);
  body.name = named.name;
  body.where = named.value.where();
  check_turning(section.find("angular_velocity"), body.angular_velocity, body);
  check_turning(section.find("torque"), body.torque, body);
  check_pitch(section.find("orientation"), body);
  return {{body, named.value}, body.attachment_values};
}

}   // namespace

Form bodies_form() { return map_form("a map from names to bodies", section_form(body_table)); }

std::vector<BodyDraft> read_bodies(const Value& value) {
  std::vector<BodyDraft> bodies;
  for (const Named& named : read_named(value, bodies_form().expected)) bodies.push_back(read_body(named));
  return bodies;
}

}   // namespace cablenet::scene
