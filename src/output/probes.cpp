#include "cablenet/output/probes.hpp"

#include <algorithm>
#include <cmath>

#include "cablenet/elements/cable.hpp"

namespace cablenet::output {
namespace {

/// The local node of each scene node; none where the node is not on this rank.
Table<SceneNode, LocalNode> local_nodes(const partition::LocalNetwork& here, int scene_nodes) {
  Table<SceneNode, LocalNode> local(scene_nodes);
  for (LocalNode node(0); node.value() < here.nodes; ++node) local[here.scene_node[node]] = node;
  return local;
}

/// The local index of each scene element that belongs to this rank; -1 for the others.
std::vector<int> own_elements(const partition::LocalNetwork& here, std::size_t scene_elements) {
  std::vector<int> own(scene_elements, -1);
  for (int i = 0; i < here.own_elements; ++i) own[at(here.scene_element[at(i)])] = i;
  return own;
}

constexpr const char* energy_names[] = {"kinetic",    "strain",  "gravity", "work", "total",
                                        "dissipated", "damping", "water",   "bed",  "balance"};

constexpr const char* motion_names[] = {"x", "y", "z", "vx", "vy", "vz", "ax", "ay", "az"};

/// Free nodes with one element and no load.  Nothing but the element pulls at them.
Table<SceneNode, bool> bare_ends(const network::Network& network) {
  Table<SceneNode, int> pulls(network.position.size(), 0);
  for (const auto& element : network.elements)
    for (const SceneNode node : element.node) ++pulls[node];
  for (const auto& held : network.prescribed) pulls[held.node] += 2;
  for (const auto& load : network.loads) pulls[load.node] += 2;
  for (std::size_t i = 0; i < network.points.size(); ++i)
    if (network.points[i].force_law) pulls[network.point_node[i]] += 2;
  for (const auto& carried : network.carried) pulls[carried.node] += 2;
  for (const auto& link : network.links) pulls[link.node[0]] += 2;
  Table<SceneNode, bool> bare(pulls.size());
  std::transform(pulls.begin(), pulls.end(), bare.begin(), [](int count) { return count == 1; });
  return bare;
}

}   // namespace

Probes::Probes(const scene::Scene& scene, const network::Network& network, const system::Assembler& assembler)
    : assembler_(assembler), columns_{"time"}, energy_(scene.output.energy) {
  const partition::LocalNetwork& here = assembler.network();
  Lookup where{
      local_nodes(here, network.position.size()), own_elements(here, network.elements.size()), bare_ends(network), {}};
  for (int i = 0; i < here.own_elements; ++i)
    for (int side = 0; side < 2; ++side)
      if (const LocalNode node = here.elements[at(i)].node[at(side)]; !here.is_free(node))
        where.ends[node].push_back({i, side});
  for (const auto& item : scene.output.history) {
    if (item.kind == scene::HistoryKind::point) add_point(scene, network, item.index, where);
    if (item.kind == scene::HistoryKind::body) add_body(network, item.index);
    if (item.kind == scene::HistoryKind::cable) add_cable(network, item.index, where);
  }
  if (energy_)
    for (const char* name : energy_names) columns_.push_back(std::string("energy.") + name);
  row_.resize(columns_.size());
}

void Probes::add_point(const scene::Scene& scene, const network::Network& network, int index, const Lookup& where) {
  const partition::LocalNetwork& here = assembler_.network();
  const SceneNode node = network.point_node[at(index)];
  const scene::Point& point = scene.points[at(index)];
  PointProbe probe{columns_.size()};
  probe.prescribed = point.motion.has_value();
  const LocalNode local = where.node[node];
  if (local.exists() && here.primary[local]) probe.node = local;
  if (const auto ends = where.ends.find(local); ends != where.ends.end()) probe.ends = ends->second;
  points_.push_back(probe);
  for (const char* name : motion_names) columns_.push_back(point.name + "." + name);
  if (probe.prescribed)
    for (const char* name : {"fx", "fy", "fz"}) columns_.push_back(point.name + "." + name);
}

void Probes::add_body(const network::Network& network, int index) {
  const partition::LocalNetwork& here = assembler_.network();
  BodyProbe probe{columns_.size()};
  for (std::size_t b = 0; b < at(here.own_bodies); ++b)
    if (here.bodies[b].body == index) probe = {columns_.size(), here.bodies[b].node, b};
  bodies_.push_back(probe);
  const std::string& body = network.bodies[at(index)].name;
  for (const char* name : motion_names) columns_.push_back(body + "." + name);
  for (const char* name : {"qw", "qx", "qy", "qz", "wx", "wy", "wz"}) columns_.push_back(body + "." + name);
}

void Probes::add_cable(const network::Network& network, int index, const Lookup& where) {
  const network::Span& span = network.spans[at(index)];
  const std::array<int, 2> element{span.first_element, span.first_element + span.elements - 1};
  for (int side = 0; side < 2; ++side) {
    const int local = where.element[at(element[at(side)])];
    const SceneNode node = network.elements[at(element[at(side)])].node[at(side)];
    if (local >= 0 && !where.bare_end[node]) cables_.push_back({columns_.size(), {local, side}});
    columns_.push_back(span.name + (side == 0 ? ".tension_from" : ".tension_to"));
  }
}

void Probes::put(std::size_t column, const Vector3& value) {
  for (std::size_t k = 0; k < 3; ++k) row_[column + k] += value(static_cast<Eigen::Index>(k));
}

void Probes::put_motion(std::size_t column, const system::LocalState& state, LocalNode node) {
  put(column, state.position(node));
  put(column + 3, state.velocity(node));
  put(column + 6, state.acceleration(node));
}

const std::vector<double>& Probes::row(const system::LocalState& state) {
  const partition::LocalNetwork& here = assembler_.network();
  std::fill(row_.begin(), row_.end(), 0.0);
  for (const PointProbe& probe : points_) {
    if (probe.node.exists()) put_motion(probe.column, state, probe.node);
    for (const ElementEnd& end : probe.ends) put(probe.column + 9, assembler_.end_force(end.element, at(end.side)));
    if (probe.prescribed && probe.node.exists()) put(probe.column + 9, assembler_.node_force(probe.node));
  }
  for (const BodyProbe& probe : bodies_) {
    if (!probe.node.exists()) continue;
    put_motion(probe.column, state, probe.node);
    const auto& [q, w] = state.bodies[probe.body];
    row_[probe.column + 9] = q.w();
    put(probe.column + 10, q.vec());
    put(probe.column + 13, w);
  }
  for (const CableProbe& probe : cables_) {
    const partition::LocalElement& element = here.elements[at(probe.end.element)];
    const double tension =
        elements::cable_tension(here.materials[at(element.material)], element.length, state.chord(element));
    row_[probe.column] =
        std::copysign(assembler_.end_force(probe.end.element, at(probe.end.side)).norm(), tension < 0 ? -1 : 1);
  }
  if (energy_) {
    const system::Energies e = assembler_.energies();
    const std::array values{e.kinetic,    e.strain,  e.gravity, e.work, e.total(),
                            e.dissipated, e.damping, e.water,   e.bed,  e.balance()};
    std::copy(values.begin(), values.end(), row_.end() - std::ssize(values));
  }
  int rank = 0;
  MPI_Comm_rank(assembler_.communicator(), &rank);
  MPI_Reduce(rank == 0 ? MPI_IN_PLACE : row_.data(), row_.data(), static_cast<int>(row_.size()), MPI_DOUBLE, MPI_SUM, 0,
             assembler_.communicator());
  row_.front() = state.t;
  return row_;
}

}   // namespace cablenet::output
