#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/scene/choice.hpp"

/// A rigid body as the scene describes it.
namespace cablenet::scene {

/// Where cables may be fastened to a body.
struct Attachment {
  std::string name;
  Vector3 offset;   ///< from the centre of gravity, body axes [m]
};

/// Which unknowns describe a body's attitude to the solver: a quaternion, or roll, pitch and yaw.
enum class Rotation { quaternion, euler };
template <>
inline constexpr std::array<Choice<Rotation>, 2> choices<Rotation>{
    {{Rotation::quaternion, "quaternion"}, {Rotation::euler, "euler"}}};

/// What holds a cable's end at a body: a spring to the attachment, or a bar to the centre of gravity.
struct Link {
  enum class Kind { spring, bar } kind;
  double axial_stiffness;   ///< EA [N], > 0
};

struct Body {
  std::string name;
  std::string where;                    ///< "file:line" for messages
  double mass = 0;                      ///< [kg], > 0
  std::optional<Matrix3> inertia;       ///< about the centre of gravity, body axes [kg m^2]; none: a point mass
  Vector3 position = Vector3::Zero();   ///< of the centre of gravity, drawn [m]
  Quaternion attitude = Quaternion::Identity();   ///< drawn, unit: body axes to world
  Vector3 velocity = Vector3::Zero();             ///< [m/s]
  Vector3 angular_velocity = Vector3::Zero();     ///< body axes [rad/s]
  Vector3 force = Vector3::Zero();                ///< constant, world frame [N]
  Vector3 torque = Vector3::Zero();               ///< constant, body axes [N m]
  std::vector<Attachment> attachments;
  Rotation rotation = Rotation::quaternion;
  double volume = 0;                              ///< [m^3]
  Vector3 center_of_buoyancy = Vector3::Zero();   ///< from the centre of gravity, body axes [m]
  std::array<double, 6> linear_drag{};            ///< along and about the body axes [N s/m], [N m s]
  std::array<double, 6> quadratic_drag{};         ///< [N s^2/m^2], [N m s^2]
  std::array<double, 6> added_mass{};             ///< [kg], [kg m^2]
  /// Where the body touches the bed, from the centre of gravity, body axes [m].  None: at the corners of its inertia's
  /// box.
  std::optional<std::vector<Vector3>> contact;
  std::optional<Link> link;   ///< without one, cables end on the attachments themselves
};

}   // namespace cablenet::scene
