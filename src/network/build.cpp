#include "cablenet/network/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "bodies.hpp"
#include "cablenet/base/errors.hpp"
#include "cablenet/network/hanging.hpp"
#include "cablenet/network/shape.hpp"
#include "pretension.hpp"

namespace cablenet::network {
namespace {

/// Builds a network piece by piece.  A tapped cable is laid before the cables that branch from it.
class Builder {
public:
  explicit Builder(const scene::Scene& scene) : scene_(scene) {}

  Network build() {
    number_nodes();
    place_points();
    for (std::size_t i = 0; i < scene_.nets.size(); ++i) lay_net(i);
    for (std::size_t i = 0; i < scene_.cables.size(); ++i) set_end_velocities(i);
    for (std::size_t i = 0; i < scene_.cables.size(); ++i) lay_cable(i);
    for (std::size_t i = 0; i < scene_.cables.size(); ++i) add_cable_elements(i);
    for (std::size_t i = 0; i < scene_.nets.size(); ++i) add_net_elements(i);
    check();
    return std::move(network_);
  }

private:
  void number_nodes();
  void place_points();
  void lay_net(std::size_t index);
  void lay_cable(std::size_t index);
  void place_cable(std::size_t index, const Vector3& a, const Vector3& b);
  void set_end_velocities(std::size_t index);
  void set_velocities(std::size_t index);
  void set_end_velocity(std::size_t index, const scene::CableEnd& end, const Vector3& velocity);
  void compare_velocity(std::size_t index, const scene::BodyEnd& end, const Vector3& velocity) const;
  void add_cable_elements(std::size_t index);
  void add_net_elements(std::size_t index);
  void check() const;

  SceneNode end_node(const scene::CableEnd& end);
  SceneNode net_node(int net, int i, int j) const {
    return first_net_node_[at(net)] + j * (scene_.nets[at(net)].meshes[0] + 1) + i;
  }
  SceneNode cable_node(std::size_t index, int k);
  [[noreturn]] void complain(const scene::Cable& cable, const std::string& what) const {
    throw InputError(fmt::format("{}: cables.{}: {}", cable.where, cable.name, what));
  }

  const scene::Scene& scene_;
  Network network_;
  std::vector<SceneNode> first_net_node_;
  std::vector<SceneNode> first_inner_node_;
  std::vector<std::vector<double>> taps_;   ///< per cable: arc lengths of its taps
  std::vector<std::vector<double>> arcs_;   ///< per cable: arc lengths of its nodes; empty until the cable is laid
  Table<SceneNode, bool> prescribed_;
  AttachmentNodes attachment_nodes_;
};

void Builder::number_nodes() {
  const int points = static_cast<int>(scene_.points.size());
  network_.position.resize(points, Vector3::Zero());
  network_.velocity.resize(points, Vector3::Zero());
  attachment_nodes_ = add_bodies(scene_, network_);
  std::int64_t nodes = network_.position.size();
  std::int64_t elements = 0;
  for (const auto& net : scene_.nets) {
    first_net_node_.emplace_back(static_cast<int>(nodes));
    nodes += static_cast<std::int64_t>(net.meshes[0] + 1) * (net.meshes[1] + 1);
    elements += 2 * static_cast<std::int64_t>(net.meshes[0] + 1) * (net.meshes[1] + 1);
  }
  for (const auto& cable : scene_.cables) {
    first_inner_node_.emplace_back(static_cast<int>(nodes));
    nodes += cable.elements - 1;
    elements += cable.elements;
  }
  if (3 * std::max(nodes, elements) > std::numeric_limits<int>::max())
    throw InputError(
        fmt::format("{}: {} nodes are more than this build's 32-bit numbers can count", scene_.file, nodes));
  network_.position.resize(static_cast<int>(nodes), Vector3::Zero());
  network_.velocity.resize(static_cast<int>(nodes), Vector3::Zero());
  prescribed_.resize(static_cast<int>(nodes), false);
  network_.gravity = scene_.gravity;
  network_.surroundings = make_surroundings(scene_);
  network_.pretensions = pretensions_of(scene_);
  for (const auto& type : scene_.cable_types)
    network_.materials.push_back({type.axial_stiffness,
                                  type.axial_damping + type.rayleigh_stiffness * type.axial_stiffness,
                                  type.mass_per_length, type.rayleigh_mass, type.tension_only});
  taps_.resize(scene_.cables.size());
  arcs_.resize(scene_.cables.size());
  for (const auto& cable : scene_.cables)
    for (const auto& end : {cable.from, cable.to})
      if (const auto* tap = std::get_if<scene::TapEnd>(&end)) taps_[at(tap->cable)].push_back(tap->at);
}

void Builder::place_points() {
  network_.points = scene_.points;
  for (std::size_t i = 0; i < scene_.points.size(); ++i) {
    const scene::Point& point = scene_.points[i];
    const SceneNode node = network_.point_node.emplace_back(static_cast<int>(i));
    network_.position[node] = point.position;
    network_.velocity[node] = point.velocity;
    if (point.motion) {
      const scene::Kinematics start = point.motion->at(scene_.time.start);
      network_.position[node] = start.x;
      network_.velocity[node] = start.v;
      network_.prescribed.push_back({node, *point.motion});
      prescribed_[node] = true;
    }
    if (point.mass > 0 || !point.force.isZero(0)) network_.loads.push_back({node, point.mass, point.force});
    if (const auto spot = bed_spot_of(point, node, scene_)) network_.bed_spots.push_back(*spot);
    const bool is_wet = point.volume > 0 || point.drag_area > 0 || point.added_mass > 0;
    if (is_wet && scene_.fluid && !point.motion)
      network_.wet_points.push_back({node, point_in_water(point, scene_.fluid->density)});
  }
}

void Builder::lay_net(std::size_t index) {
  const scene::Net& net = scene_.nets[index];
  const auto& c = net.corners;
  for (int j = 0; j <= net.meshes[1]; ++j)
    for (int i = 0; i <= net.meshes[0]; ++i) {
      const double u = static_cast<double>(i) / net.meshes[0];
      const double w = static_cast<double>(j) / net.meshes[1];
      const SceneNode node = net_node(static_cast<int>(index), i, j);
      network_.position[node] = (1 - w) * ((1 - u) * c[0] + u * c[1]) + w * ((1 - u) * c[3] + u * c[2]);
      const bool held = std::any_of(net.fixed.begin(), net.fixed.end(), [&](scene::Edge edge) {
        using scene::Edge;
        return (edge == Edge::top && j == 0) || (edge == Edge::right && i == net.meshes[0]) ||
               (edge == Edge::bottom && j == net.meshes[1]) || (edge == Edge::left && i == 0);
      });
      if (!held) continue;
      prescribed_[node] = true;
      network_.prescribed.push_back({node, scene::Motion::fixed(network_.position[node])});
    }
}

SceneNode Builder::cable_node(std::size_t index, int k) {
  const scene::Cable& cable = scene_.cables[index];
  if (k == 0) return end_node(cable.from);
  if (k == cable.elements) return end_node(cable.to);
  return first_inner_node_[index] + (k - 1);
}

SceneNode Builder::end_node(const scene::CableEnd& end) {
  if (const auto* point = std::get_if<scene::PointEnd>(&end)) return SceneNode(point->point);
  if (const auto* net = std::get_if<scene::NetEnd>(&end)) return net_node(net->net, net->node[0], net->node[1]);
  if (const auto* body = std::get_if<scene::BodyEnd>(&end))
    return attachment_nodes_[at(body->body)][at(body->attachment)];
  const auto& tap = std::get<scene::TapEnd>(end);
  lay_cable(at(tap.cable));
  return cable_node(at(tap.cable), node_at(arcs_[at(tap.cable)], tap.at));
}

void Builder::lay_cable(std::size_t index) {
  if (!arcs_[index].empty()) return;
  const scene::Cable& cable = scene_.cables[index];
  const Vector3 a = network_.position[end_node(cable.from)];
  const Vector3 b = network_.position[end_node(cable.to)];
  const double length = cable.tension ? first_length(scene_, cable, a, b) : cable.length.value_or((b - a).norm());
  if (!(length > 0)) complain(cable, "its two ends lie on one point, so its length must be given; add `length`");
  for (const double tap : taps_[index])
    if (tap > length * (1 + 1e-9))
      complain(cable,
               fmt::format("a cable is tapped from it at {} m, but its unstretched length is {} m", tap, length));
  try {
    arcs_[index] = node_arcs(length, cable.elements, taps_[index], cable.density);
  } catch (const InputError& problem) {
    complain(cable, problem.what());
  }
  place_cable(index, a, b);
  set_velocities(index);
}

void Builder::place_cable(std::size_t index, const Vector3& a, const Vector3& b) {
  const scene::Cable& cable = scene_.cables[index];
  const std::vector<double>& arcs = arcs_[index];
  std::vector<Vector3> points;
  if (cable.shape == scene::Shape::straight) points = straight_shape(a, b, arcs);
  if (cable.shape == scene::Shape::catenary)
    points = catenary_shape(a, b, arcs, hanging_of(scene_, scene_.cable_types[at(cable.type)], a, b));
  if (cable.shape == scene::Shape::polyline) {
    points = cable.has_chosen_mesh ? remeshed_shape(cable.polyline, arcs) : polyline_shape(cable.polyline, arcs);
    const double miss = std::max((points.front() - a).norm(), (points.back() - b).norm());
    if (miss > 1e-3 * arcs.back())
      complain(cable,
               fmt::format("shape: the polyline's ends miss the cable's ends by {:.3g} m; it must run from `from` "
                           "({:.6g}, {:.6g}, {:.6g}) to `to` ({:.6g}, {:.6g}, {:.6g})",
                           miss, a.x(), a.y(), a.z(), b.x(), b.y(), b.z()));
  }
  for (int k = 1; k < cable.elements; ++k) network_.position[cable_node(index, k)] = points[at(k)];
}

/// This has to come before any cable is laid: another cable at the same point may interpolate its nodes' velocities
/// from the velocity that this cable gives the point.
void Builder::set_end_velocities(std::size_t index) {
  const scene::Cable& cable = scene_.cables[index];
  if (cable.node_velocity.empty()) return;
  set_end_velocity(index, cable.from, cable.node_velocity.front());
  set_end_velocity(index, cable.to, cable.node_velocity.back());
}

void Builder::set_velocities(std::size_t index) {
  const scene::Cable& cable = scene_.cables[index];
  const std::vector<double>& arcs = arcs_[index];
  const Vector3 v0 = network_.velocity[end_node(cable.from)];
  const Vector3 v1 = network_.velocity[end_node(cable.to)];
  const std::vector<Vector3>& rows = cable.node_velocity;
  for (int k = 1; k < cable.elements; ++k)
    network_.velocity[cable_node(index, k)] = rows.empty()            ? v0 + (v1 - v0) * (arcs[at(k)] / arcs.back())
                                              : cable.has_chosen_mesh ? row_at(rows, arcs[at(k)] / arcs.back())
                                                                      : rows[at(k)];
}

/// A free point without a drawn velocity takes the cable's.  Prescribed points, taps and net nodes keep their own.
void Builder::set_end_velocity(std::size_t index, const scene::CableEnd& end, const Vector3& velocity) {
  if (const auto* body = std::get_if<scene::BodyEnd>(&end)) return compare_velocity(index, *body, velocity);
  const auto* point = std::get_if<scene::PointEnd>(&end);
  if (point == nullptr || prescribed_[SceneNode(point->point)]) return;
  Vector3& own = network_.velocity[SceneNode(point->point)];
  if (own.isZero(0)) own = velocity;
  if ((own - velocity).norm() > 1e-6 * own.norm())
    complain(scene_.cables[index],
             fmt::format("node_velocity: gives point {} another velocity than the point itself or another cable does",
                         scene_.points[at(point->point)].name));
}

void Builder::compare_velocity(std::size_t index, const scene::BodyEnd& end, const Vector3& velocity) const {
  const Vector3& own = network_.velocity[attachment_nodes_[at(end.body)][at(end.attachment)]];
  if ((own - velocity).norm() <= 1e-6 * std::max(own.norm(), velocity.norm())) return;
  const scene::Body& body = scene_.bodies[at(end.body)];
  complain(scene_.cables[index],
           fmt::format("node_velocity: its row at {}.{} is not how the body moves there, ({:.6g}, {:.6g}, {:.6g}) m/s; "
                       "correct it or the body's velocity and angular_velocity",
                       body.name, body.attachments[at(end.attachment)].name, own.x(), own.y(), own.z()));
}

void Builder::add_cable_elements(std::size_t index) {
  const scene::Cable& cable = scene_.cables[index];
  network_.spans.push_back({cable.name, static_cast<int>(network_.elements.size()), cable.elements});
  for (int k = 0; k < cable.elements; ++k)
    network_.elements.push_back(
        {{cable_node(index, k), cable_node(index, k + 1)}, cable.type, arcs_[index][at(k) + 1] - arcs_[index][at(k)]});
}

void Builder::add_net_elements(std::size_t index) {
  const scene::Net& net = scene_.nets[index];
  const int id = static_cast<int>(index);
  const int first = static_cast<int>(network_.elements.size());
  const double slack = net.prestress ? first_slack(scene_, net) : net.slack;
  const auto join = [&](SceneNode a, SceneNode b) {
    const double drawn = (network_.position[b] - network_.position[a]).norm();
    network_.elements.push_back({{a, b}, net.type, slack * drawn});
  };
  for (int j = 0; j <= net.meshes[1]; ++j)
    for (int i = 0; i <= net.meshes[0]; ++i) {
      if (i < net.meshes[0]) join(net_node(id, i, j), net_node(id, i + 1, j));
      if (j < net.meshes[1]) join(net_node(id, i, j), net_node(id, i, j + 1));
    }
  network_.spans.push_back({net.name, first, static_cast<int>(network_.elements.size()) - first});
}

void Builder::check() const {
  for (std::size_t i = 0; i < network_.elements.size(); ++i) {
    const Element& element = network_.elements[i];
    const double drawn = (network_.position[element.node[1]] - network_.position[element.node[0]]).norm();
    if (!(drawn > 1e-9 * element.length) || !(element.length > 0))
      throw InputError(
          fmt::format("{}: {}: its two nodes are drawn on one point; draw the cable so that neighbouring nodes "
                      "lie apart",
                      scene_.file, network_.element_name(static_cast<int>(i))));
  }
  if (std::all_of(prescribed_.begin(), prescribed_.end(), [](bool held) { return held; }))
    throw InputError(
        fmt::format("{}: every node is held or moved, so nothing is left to solve; give a cable more than one "
                    "element or set a point free",
                    scene_.file));
}

}   // namespace

Network build_network(const scene::Scene& scene) { return Builder(scene).build(); }

}   // namespace cablenet::network
