#include "bodies.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "cablenet/base/index.hpp"
#include "cablenet/bodies/body_box.hpp"
#include "cablenet/bodies/rigid_body.hpp"

namespace cablenet::network {
namespace {

std::vector<std::vector<bool>> used_attachments(const scene::Scene& scene) {
  std::vector<std::vector<bool>> used;
  for (const auto& body : scene.bodies) used.emplace_back(body.attachments.size(), false);
  for (const auto& cable : scene.cables)
    for (const auto* end : {&cable.from, &cable.to})
      if (const auto* fastened = std::get_if<scene::BodyEnd>(end))
        used[at(fastened->body)][at(fastened->attachment)] = true;
  return used;
}

bodies::Rotation rotation_of(const scene::Body& body) {
  if (!body.inertia) return bodies::Rotation::none;
  return body.rotation == scene::Rotation::euler ? bodies::Rotation::euler : bodies::Rotation::quaternion;
}

SceneNode add_node(Network& network, const Vector3& position, const Vector3& velocity) {
  network.velocity.push_back(velocity);
  return network.position.push_back(position);
}

double reach_of(const scene::Body& body, const Matrix3& inertia) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> about_axes(inertia, Eigen::EigenvaluesOnly);
  double reach = std::sqrt(about_axes.eigenvalues().maxCoeff() / body.mass);
  for (const scene::Attachment& attachment : body.attachments) reach = std::max(reach, attachment.offset.norm());
  return reach;
}

Body make_body(const scene::Body& body, Network& network) {
  const bodies::Rotation rotation = rotation_of(body);
  const SceneNode node = add_node(network, body.position, body.velocity);
  network.loads.push_back({node, body.mass, body.force});
  const Matrix3 inertia = body.inertia.value_or(Matrix3::Zero());
  return {body.name,
          node,
          {rotation, inertia, body.torque, body.attitude, Vector3::Zero(), Vector3::Zero()},
          bodies::rotation_state(rotation, body.attitude, body.angular_velocity),
          std::nullopt,
          static_cast<int>(network.carried.size()),
          0,
          reach_of(body, inertia)};
}

SceneNode add_carried(const scene::Body& from, const Vector3& offset, Body& body, Network& network) {
  const Vector3 position = from.position + from.attitude * offset;
  const Vector3 velocity = from.velocity + from.attitude * from.angular_velocity.cross(offset);
  const SceneNode node = add_node(network, position, velocity);
  network.carried.push_back({node, static_cast<int>(network.bodies.size()), offset});
  ++body.carried;
  return node;
}

Vector3 three(const std::array<double, 6>& values, std::size_t first) {
  return {values[first], values[first + 1], values[first + 2]};
}

/// Added inertia turns with the body, so it becomes part of the body's inertia.  Buoyancy becomes a force at the centre
/// of buoyancy, which is a carried node unless it is the centre of gravity.
void put_in_water(const scene::Body& from, double density, Body& body, Network& network) {
  const Vector3 linear = three(from.linear_drag, 0), quadratic = three(from.quadratic_drag, 0);
  const double radius = wetted_radius(from.volume, 2 / density * quadratic.maxCoeff());
  body.water = {linear, quadratic, three(from.added_mass, 0), radius, Vector3::Zero()};
  if (body.properties.rotation != bodies::Rotation::none) {
    body.water->added_inertia = three(from.added_mass, 3);
    body.properties.inertia += body.water->added_inertia.asDiagonal();
    body.properties.linear_drag = three(from.linear_drag, 3);
    body.properties.quadratic_drag = three(from.quadratic_drag, 3);
  }
  if (from.volume == 0) return;
  const bool central = from.center_of_buoyancy.isZero(0) || body.properties.rotation == bodies::Rotation::none;
  const SceneNode node = central ? body.node : add_carried(from, from.center_of_buoyancy, body, network);
  network.wet_points.push_back({node, {density * from.volume, 0, 0, radius}});
}

/// The node at which the cables of an attachment end.  It is the body's own node, a carried node, or a free node that a
/// link ties to a carried one, or to the body.
SceneNode add_attachment(const scene::Body& from, const Vector3& offset, Body& body, Network& network) {
  const bool centred = offset.isZero(0);
  if (centred && body.properties.rotation == bodies::Rotation::none) return body.node;
  const SceneNode node = add_carried(from, offset, body, network);
  if (!from.link || centred) return node;
  const SceneNode end = add_node(network, network.position[node], network.velocity[node]);
  const double length = offset.norm();
  const bool is_bar = from.link->kind == scene::Link::Kind::bar;
  network.links.push_back({{end, node}, from.link->axial_stiffness / length, is_bar ? length : 0});
  return end;
}

/// The corners of the box that has the body's inertia, or the spots that the scene names.  Each takes a quarter of the
/// mean of the box's faces.  What does not turn is a sphere.
void put_on_bed(const scene::Body& from, const scene::Scene& scene, Body& body, Network& network) {
  const double displaced = scene.fluid ? scene.fluid->density * from.volume : 0;
  const double weight = std::max(scene.gravity * (from.mass - displaced), 0.0);
  if (body.properties.rotation == bodies::Rotation::none) {
    const double radius = wetted_radius(from.volume, 0);
    if (radius > 0) network.bed_spots.push_back(bed_spot(sphere(radius), body.node, weight, scene));
    return;
  }
  const bodies::BodyBox box = bodies::body_box(from.mass, from.inertia);
  const Vector3& edges = box.edges;
  const double faces = (edges.x() * edges.y() + edges.y() * edges.z() + edges.z() * edges.x()) / 3;
  std::vector<Vector3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(box.attitude * edges.cwiseProduct(Vector3(i & 1, i >> 1 & 1, i >> 2) - Vector3::Constant(0.5)));
  for (const Vector3& spot : from.contact.value_or(corners)) {
    const SceneNode node = spot.isZero(0) ? body.node : add_carried(from, spot, body, network);
    network.bed_spots.push_back(bed_spot({0, faces / 4, edges.maxCoeff()}, node, weight / 4, scene));
  }
}

}   // namespace

AttachmentNodes add_bodies(const scene::Scene& scene, Network& network) {
  const auto used = used_attachments(scene);
  AttachmentNodes nodes;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const scene::Body& from = scene.bodies[i];
    Body body = make_body(from, network);
    nodes.emplace_back(from.attachments.size());
    for (std::size_t k = 0; k < from.attachments.size(); ++k)
      if (used[i][k]) nodes[i][k] = add_attachment(from, from.attachments[k].offset, body, network);
    if (scene.fluid) put_in_water(from, scene.fluid->density, body, network);
    if (scene.bed) put_on_bed(from, scene, body, network);
    network.bodies.push_back(std::move(body));
  }
  return nodes;
}

}   // namespace cablenet::network
