#include "cablenet/output/frames.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "cablenet/bodies/body_box.hpp"
#include "cablenet/elements/cable.hpp"

namespace cablenet::output {
namespace {

using petsc::check;

/// The position, velocity, quaternion and angular velocity of a body: 3 + 3 + 4 + 3.
constexpr std::size_t values_per_body = 13;

std::int64_t block_start(std::int64_t count, int rank, int ranks) { return count * rank / ranks; }

/// The rank whose block has item `index` of `count`, and the item's index in that block.
PetscSFNode root_of(std::int64_t count, std::int64_t index, int ranks) {
  int rank = static_cast<int>(((index + 1) * ranks - 1) / count);
  while (block_start(count, rank, ranks) > index) --rank;
  while (block_start(count, rank + 1, ranks) <= index) ++rank;
  return {rank, static_cast<PetscInt>(index - block_start(count, rank, ranks))};
}

/// Sends `width` doubles from each leaf to its root.  Collective.
void send(PetscSF forest, int width, const std::vector<double>& leaves, std::vector<double>& roots, MPI_Op operation) {
  MPI_Datatype unit = MPI_DOUBLE;
  if (width > 1) {
    MPI_Type_contiguous(width, MPI_DOUBLE, &unit);
    MPI_Type_commit(&unit);
  }
  check(PetscSFReduceBegin(forest, unit, leaves.data(), roots.data(), operation));
  check(PetscSFReduceEnd(forest, unit, leaves.data(), roots.data(), operation));
  if (width > 1) MPI_Type_free(&unit);
}

}   // namespace

Frames::Frames(const network::Network& network, const partition::Partition& partition,
               const system::Assembler& assembler)
    : assembler_(assembler) {
  MPI_Comm_rank(assembler.communicator(), &rank_);
  MPI_Comm_size(assembler.communicator(), &ranks_);
  fill_mesh(network, partition);
  make_forests();
  points_.resize(at(3 * mesh_.local_nodes));
  velocity_.resize(at(3 * mesh_.local_nodes));
  block_node_tension_.resize(at(mesh_.local_nodes));
  elements_at_node_.assign(at(mesh_.local_nodes), 0);
  block_tension_.resize(mesh_.lines.size());
  block_strain_.resize(mesh_.lines.size());
  const partition::LocalNetwork& here = assembler_.network();
  tension_.resize(at(here.own_elements));
  strain_.resize(at(here.own_elements));
  node_tension_.assign(at(here.nodes), 0);
  for (std::size_t i = 0; i < at(here.own_elements); ++i)
    for (const LocalNode node : here.elements[i].node) node_tension_[at(node)] += 1;
  send(all_nodes_, 1, node_tension_, elements_at_node_, MPI_SUM);
}

void Frames::fill_mesh(const network::Network& network, const partition::Partition& partition) {
  mesh_.nodes = network.position.size();
  mesh_.elements = static_cast<std::int64_t>(network.elements.size());
  mesh_.first_node = block_start(mesh_.nodes, rank_, ranks_);
  mesh_.local_nodes = block_start(mesh_.nodes, rank_ + 1, ranks_) - mesh_.first_node;
  mesh_.first_element = block_start(mesh_.elements, rank_, ranks_);
  std::size_t span = 0;
  for (auto e = mesh_.first_element; e < block_start(mesh_.elements, rank_ + 1, ranks_); ++e) {
    while (e >= network.spans[span].first_element + network.spans[span].elements) ++span;
    const auto& [from, to] = network.elements[at(e)].node;
    mesh_.lines.push_back({from.value(), to.value()});
    mesh_.cable_id.push_back(static_cast<int>(span));
    mesh_.rank.push_back(partition.element_owner[at(e)]);
  }
  for (const auto& cable : network.spans) mesh_.cable_names.push_back(cable.name);
  fill_bodies(network);
}

void Frames::fill_bodies(const network::Network& network) {
  for (const auto& body : network.bodies) mesh_.body_names.push_back(body.name);
  bodies_.resize(values_per_body * network.bodies.size());
  if (rank_ != 0) return;
  std::map<SceneNode, double> mass;
  for (const auto& load : network.loads) mass[load.node] = load.mass;
  for (const auto& body : network.bodies) {
    const bool turns = body.properties.rotation != bodies::Rotation::none;
    const auto inertia = turns ? std::optional(body.properties.inertia) : std::nullopt;
    const auto [edges, q] = bodies::body_box(mass.at(body.node), inertia);
    mesh_.body_box.insert(mesh_.body_box.end(), edges.begin(), edges.end());
    mesh_.body_box_attitude.insert(mesh_.body_box_attitude.end(), {q.w(), q.x(), q.y(), q.z()});
  }
}

/// Only the rank that owns a body has values for it, and the other ranks add zeros.  The values are few, so a sum is
/// cheap.
void Frames::collect_bodies(const system::LocalState& state) {
  const partition::LocalNetwork& here = assembler_.network();
  const std::size_t bodies = mesh_.body_names.size();
  std::fill(bodies_.begin(), bodies_.end(), 0.0);
  for (std::size_t b = 0; b < at(here.own_bodies); ++b) {
    const std::size_t body = at(here.bodies[b].body);
    const auto& [q, w] = state.bodies[b];
    const Vector3 x = state.position(here.bodies[b].node);
    const Vector3 v = state.velocity(here.bodies[b].node);
    std::copy(x.begin(), x.end(), bodies_.data() + 3 * body);
    std::copy(v.begin(), v.end(), bodies_.data() + 3 * (bodies + body));
    std::copy_n(std::array{q.w(), q.x(), q.y(), q.z()}.begin(), 4, bodies_.data() + 6 * bodies + 4 * body);
    std::copy(w.begin(), w.end(), bodies_.data() + 10 * bodies + 3 * body);
  }
  MPI_Reduce(rank_ == 0 ? MPI_IN_PLACE : bodies_.data(), bodies_.data(), static_cast<int>(bodies_.size()), MPI_DOUBLE,
             MPI_SUM, 0, assembler_.communicator());
}

void Frames::make_forests() {
  const partition::LocalNetwork& here = assembler_.network();
  std::vector<PetscInt> spoken_for;
  std::vector<PetscSFNode> spoken_roots, node_roots, element_roots;
  for (LocalNode node(0); node.value() < here.nodes; ++node) {
    node_roots.push_back(root_of(mesh_.nodes, here.scene_node[node].value(), ranks_));
    if (!here.primary[node]) continue;
    spoken_for.push_back(node.value());
    spoken_roots.push_back(node_roots.back());
  }
  for (std::size_t i = 0; i < at(here.own_elements); ++i)
    element_roots.push_back(root_of(mesh_.elements, here.scene_element[i], ranks_));
  const auto create = [&](StarForest& forest, std::int64_t roots, std::vector<PetscInt>* leaves,
                          std::vector<PetscSFNode>& remote) {
    check(PetscSFCreate(assembler_.communicator(), forest.out()));
    check(PetscSFSetGraph(forest, static_cast<PetscInt>(roots), static_cast<PetscInt>(remote.size()),
                          leaves == nullptr ? nullptr : leaves->data(), PETSC_COPY_VALUES, remote.data(),
                          PETSC_COPY_VALUES));
    check(PetscSFSetUp(forest));
  };
  create(nodes_, mesh_.local_nodes, &spoken_for, spoken_roots);
  create(all_nodes_, mesh_.local_nodes, nullptr, node_roots);
  create(elements_, static_cast<std::int64_t>(mesh_.lines.size()), nullptr, element_roots);
}

void Frames::compute_tensions(const system::LocalState& state) {
  const partition::LocalNetwork& here = assembler_.network();
  std::fill(node_tension_.begin(), node_tension_.end(), 0.0);
  for (std::size_t i = 0; i < at(here.own_elements); ++i) {
    const partition::LocalElement& element = here.elements[i];
    const elements::Chord chord = state.chord(element);
    tension_[i] = elements::cable_tension(here.materials[at(element.material)], element.length, chord);
    strain_[i] = (chord.d.norm() - element.length) / element.length;
    for (const LocalNode node : element.node) node_tension_[at(node)] += tension_[i];
  }
}

Frame Frames::collect(const system::LocalState& state, long step) {
  compute_tensions(state);
  send(nodes_, 3, state.x, points_, MPI_REPLACE);
  send(nodes_, 3, state.v, velocity_, MPI_REPLACE);
  send(elements_, 1, tension_, block_tension_, MPI_REPLACE);
  send(elements_, 1, strain_, block_strain_, MPI_REPLACE);
  std::fill(block_node_tension_.begin(), block_node_tension_.end(), 0.0);
  send(all_nodes_, 1, node_tension_, block_node_tension_, MPI_SUM);
  for (std::size_t i = 0; i < block_node_tension_.size(); ++i)
    block_node_tension_[i] /= std::max(1.0, elements_at_node_[i]);
  Frame frame{state.t, step, points_, velocity_, block_node_tension_, block_tension_, block_strain_};
  const std::size_t bodies = mesh_.body_names.size();
  if (bodies == 0) return frame;
  collect_bodies(state);
  if (rank_ != 0) return frame;
  const std::span<const double> values(bodies_);
  frame.body_position = values.first(3 * bodies);
  frame.body_velocity = values.subspan(3 * bodies, 3 * bodies);
  frame.body_quaternion = values.subspan(6 * bodies, 4 * bodies);
  frame.body_angular_velocity = values.last(3 * bodies);
  return frame;
}

}   // namespace cablenet::output
