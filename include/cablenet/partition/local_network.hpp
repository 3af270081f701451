#pragma once
#include <array>
#include <optional>
#include <vector>

#include "cablenet/network/network.hpp"
#include "cablenet/partition/partition.hpp"

/// This rank's share of the network.  Local nodes are numbered: owned free nodes in solver order, ghosts (free nodes of
/// other ranks at this rank's elements), prescribed and carried nodes at this rank's elements.  A body goes with its
/// node. Elements at an owned free node or body are all here, so that nothing but the ghosts' motion has to come from
/// other ranks; one between two ranks is thus on both, and belongs to one of them. Tests:
/// tests/parallel/local_network_test.cpp
namespace cablenet::partition {

struct LocalElement {
  std::array<LocalNode, 2> node;
  std::array<Unknown, 2> unknown;   ///< of an owned node: its first unknown in this rank's vectors
  int material;
  double length;   ///< unstretched [m]
};

struct LocalBody {
  LocalNode node;   ///< owned or ghost
  int body;         ///< index into Network::bodies
  bodies::Properties properties;
  bodies::RotationState start;
  std::optional<bodies::BodyInWater> water;
  int first_carried, carried;   ///< its nodes here: [first_carried, first_carried + carried) of LocalNetwork::carried
};

struct LocalCarried {
  LocalNode node;
  int body;   ///< index into LocalNetwork::bodies
  Vector3 offset;
};

/// Elements first .. last-1.
struct Range {
  int first;
  int last;
};

struct LocalPrescribed {
  LocalNode node;
  scene::Motion motion;
};

struct LocalNetwork {
  int owned = 0;
  int ghosts = 0;
  int nodes = 0;                            ///< owned + ghosts + prescribed + carried
  SolverNumber first_number{0};             ///< of the first owned node
  int free_nodes = 0;                       ///< on all ranks together
  int interior = 0;                         ///< owned nodes before those of the interface
  Blocks blocks;                            ///< of all ranks, as in Partition
  Table<LocalNode, Unknown> begin;          ///< per owned node, and one past: its first unknown in this rank's vectors
  Interface interface;                      ///< of all ranks, as in Partition
  std::vector<SolverNumber> ghost_number;   ///< of the ghosts
  std::vector<int> ghost_owner;             ///< rank
  std::vector<int> ghost_index;             ///< its index in its owner's `sent`
  std::vector<LocalNode> sent;              ///< owned nodes that are ghosts elsewhere
  Table<LocalNode, SceneNode> scene_node;
  Table<LocalNode, bool> primary;   ///< this rank speaks for it
  /// First those between owned nodes, then the others that belong to this rank, then those that belong to another.
  std::vector<LocalElement> elements;
  int inner_elements = 0;                            ///< between owned nodes
  int own_elements = 0;                              ///< that belong to this rank
  Range attached{0, 0};                              ///< those at carried nodes, own ones first
  std::vector<int> scene_element;                    ///< per local element
  std::vector<network::NodeLoad<LocalNode>> loads;   ///< at nodes that this rank speaks for
  std::vector<LocalPrescribed> prescribed;
  std::vector<LocalBody> bodies;   ///< at owned nodes, then at ghosts
  int own_bodies = 0;
  bool has_euler_bodies = false;                 ///< on any rank
  std::vector<LocalCarried> carried;             ///< body after body
  std::vector<network::Link<LocalNode>> links;   ///< own ones first
  int own_links = 0;                             ///< that belong to this rank: the owner of the free end's
  std::vector<elements::CableMaterial> materials;
  network::Surroundings surroundings;
  std::vector<network::WetPoint<LocalNode>> wet_points;   ///< at nodes of this rank, or that its bodies carry
  double gravity = 0;                                     ///< [m/s^2] along -z
  double extent = 0;   ///< of the whole network as drawn, on all ranks alike [m]
  Table<LocalNode, Vector3> position;                     ///< at the start [m]
  Table<LocalNode, Vector3> velocity;                     ///< at the start [m/s]

  bool is_owned(LocalNode node) const { return node.value() < owned; }
  bool is_free(LocalNode node) const { return node.value() < owned + ghosts; }
  bool is_carried(LocalNode node) const { return node.value() >= nodes - static_cast<int>(carried.size()); }
  const LocalCarried& carried_at(LocalNode node) const { return carried[carried.size() - at(nodes - node.value())]; }
  /// The local node whose unknowns move this one.
  LocalNode anchor(LocalNode node) const { return is_carried(node) ? bodies[at(carried_at(node).body)].node : node; }
  /// Of this rank's vectors.
  int unknowns() const { return begin.empty() ? 0 : begin[LocalNode(owned)].value(); }
  int all_unknowns() const { return blocks.begin(SolverNumber(free_nodes)); }
  /// Of a free node.
  SolverNumber number(LocalNode node) const {
    return is_owned(node) ? first_number + node.value() : ghost_number[at(node.value() - owned)];
  }
};

LocalNetwork make_local_network(const network::Network& network, const Partition& partition, int rank);

}   // namespace cablenet::partition
