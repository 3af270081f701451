#pragma once
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/environment/bed.hpp"
#include "cablenet/environment/fluid.hpp"
#include "cablenet/scene/body.hpp"
#include "cablenet/scene/choice.hpp"
#include "cablenet/scene/force_law.hpp"
#include "cablenet/scene/motion.hpp"
#include "cablenet/scene/net.hpp"
#include "cablenet/scene/time.hpp"

/// What the user asked for, as plain data in SI units.  All copies that `repeat` asks for are listed, and things refer
/// to each other by index.  scene/read.hpp makes a scene from a file.
namespace cablenet::scene {

struct CableType {
  std::string name;
  double mass_per_length = 0;      ///< of unstretched cable [kg/m], > 0
  double axial_stiffness = 0;      ///< EA [N], > 0
  bool tension_only = false;       ///< a slack element carries nothing
  double axial_damping = 0;        ///< force per strain rate [N s]
  double rayleigh_mass = 0;        ///< [1/s]
  double rayleigh_stiffness = 0;   ///< [s]
  double area = 0;                 ///< displaced cross-section [m^2]; 0: not needed
  double diameter = 0;             ///< for drag and bed [m]; 0: not needed
  double normal_drag = 0;          ///< Cdn
  double tangential_drag = 0;      ///< Cdt
  double added_mass = 0;           ///< Ca
};

struct Point {
  std::string name;
  std::string where;                      ///< "file:line" for messages
  Vector3 position = Vector3::Zero();     ///< drawn [m]; a prescribed point is where its motion says
  Vector3 velocity = Vector3::Zero();     ///< [m/s]
  double mass = 0;                        ///< [kg]
  Vector3 force = Vector3::Zero();        ///< constant [N], world frame
  std::optional<ForceLaw> force_law;      ///< a force that depends on time; none: `force` alone acts
  std::optional<Motion> motion;           ///< none: the point is free
  double volume = 0;                      ///< [m^3]
  double drag_area = 0;                   ///< Cd A [m^2]
  double added_mass = 0;                  ///< [kg]
  std::optional<double> contact_radius;   ///< on the bed [m]; none: that of the volume's sphere
};

struct PointEnd {
  int point;   ///< index into Scene::points
};
struct TapEnd {
  int cable;   ///< index into Scene::cables
  double at;   ///< unstretched arc length from that cable's `from` [m]
};
struct NetEnd {
  int net;                   ///< index into Scene::nets
  std::array<int, 2> node;   ///< 0..meshes along the first and second edge
};
struct BodyEnd {
  int body;         ///< index into Scene::bodies
  int attachment;   ///< index into its attachments
};
using CableEnd = std::variant<PointEnd, TapEnd, NetEnd, BodyEnd>;

enum class Shape { straight, catenary, polyline };
/// A polyline is drawn as a list of its points and has no word.
template <>
inline constexpr std::array<Choice<Shape>, 2> choices<Shape>{
    {{Shape::straight, "straight"}, {Shape::catenary, "catenary"}}};

struct Cable {
  std::string name;
  std::string where;   ///< "file:line" for messages
  int type = 0;        ///< index into Scene::cable_types
  CableEnd from = PointEnd{0};
  CableEnd to = PointEnd{0};
  std::optional<double> length;    ///< unstretched [m]; none: the distance between the drawn ends
  std::optional<double> tension;   ///< at `from` in the equilibrium [N], by which the length is found
  int elements = 0;                ///< 0: Scene::accuracy asks that they be chosen
  bool has_chosen_mesh = false;    ///< The elements were chosen, so that rows of the file are no nodes.
  std::vector<double> density;     ///< of elements, relative, in equal parts of the cable; empty: everywhere alike
  Shape shape = Shape::straight;
  std::vector<Vector3> polyline;        ///< when shape is polyline, from end to end
  std::vector<Vector3> node_velocity;   ///< empty; or a row per node; with has_chosen_mesh, rows at equal distances
};

struct Scene {
  std::string file;
  std::string text;   ///< the file as read
  std::string title;
  double gravity = 9.80665;                  ///< [m/s^2] along -z
  std::optional<environment::Fluid> fluid;   ///< none: vacuum
  std::optional<environment::Bed> bed;       ///< none: no contact
  std::vector<CableType> cable_types;
  std::vector<Point> points;
  std::vector<Body> bodies;
  std::vector<Cable> cables;
  std::vector<Net> nets;
  bool is_static = false;       ///< no `time`: the equilibrium is the result
  bool starts_static = false;   ///< from the equilibrium under the loads at time.start; true where is_static
  Time time;
  std::optional<double> accuracy;   ///< wanted of each quantity, of its range; none: mesh and step are as given
  Output output;
  std::vector<std::string> notes;   ///< what is allowed but perhaps not meant: "file:line: key: text"
};

}   // namespace cablenet::scene
