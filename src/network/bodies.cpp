#include "bodies.hpp"

namespace cablenet::network {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

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

int add_node(Network& network, const Vector3& position, const Vector3& velocity) {
  network.position.push_back(position);
  network.velocity.push_back(velocity);
  return static_cast<int>(network.position.size()) - 1;
}

Body make_body(const scene::Body& body, Network& network) {
  const bodies::Rotation rotation = rotation_of(body);
  const int node = add_node(network, body.position, body.velocity);
  network.loads.push_back({node, body.mass, body.force});
  const Matrix3 inertia = body.inertia.value_or(Matrix3::Zero());
  return {body.name,
          node,
          {rotation, inertia, body.torque, body.attitude},
          bodies::rotation_state(rotation, body.attitude, body.angular_velocity),
          static_cast<int>(network.carried.size()),
          0};
}

/// The node at which cables on an attachment end: the body's own, a carried one, or one that a link ties to that.
int add_attachment(const scene::Body& from, const Vector3& offset, Body& body, Network& network) {
  const bool centred = offset.isZero(0);
  if (centred && body.properties.rotation == bodies::Rotation::none) return body.node;
  const Vector3 position = from.position + from.attitude * offset;
  const Vector3 velocity = from.velocity + from.attitude * from.angular_velocity.cross(offset);
  const int node = add_node(network, position, velocity);
  network.carried.push_back({node, static_cast<int>(network.bodies.size()), offset});
  ++body.carried;
  if (!from.link_stiffness || centred) return node;
  const int end = add_node(network, position, velocity);
  network.links.push_back({{end, node}, *from.link_stiffness / offset.norm()});
  return end;
}

}   // namespace

AttachmentNodes add_bodies(const scene::Scene& scene, Network& network) {
  const auto used = used_attachments(scene);
  AttachmentNodes nodes;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const scene::Body& from = scene.bodies[i];
    Body body = make_body(from, network);
    nodes.emplace_back(from.attachments.size(), -1);
    for (std::size_t k = 0; k < from.attachments.size(); ++k)
      if (used[i][k]) nodes[i][k] = add_attachment(from, from.attachments[k].offset, body, network);
    network.bodies.push_back(std::move(body));
  }
  return nodes;
}

}   // namespace cablenet::network
