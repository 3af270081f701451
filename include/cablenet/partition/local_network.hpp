#pragma once
#include <array>
#include <optional>
#include <vector>

#include "cablenet/network/network.hpp"
#include "cablenet/partition/partition.hpp"

/// This rank's share of the network.  Its nodes are numbered in this order: owned free nodes in solver order, ghosts,
/// prescribed nodes, carried nodes.  A ghost is a free node of another rank at an element or link of this rank.
/// A body is where its node is.  All elements at an owned free node or body are here, so that only the motion of ghosts
/// has to come from other ranks.  An element between two ranks is thus on both, and belongs to one of them.
/// Tests: tests/parallel/local_network_test.cpp
namespace cablenet::partition {

struct LocalElement {
  std::array<LocalNode, 2> node;
  std::array<Unknown, 2> unknown;   ///< the first unknown of an owned node, in this rank's vectors
  int material;
  double length;   ///< unstretched [m]
};

struct LocalBody {
  LocalNode node;   ///< an owned node or a ghost
  int body;         ///< index into Network::bodies
  bodies::Properties properties;
  bodies::RotationState start;
  std::optional<bodies::BodyInWater> water;
  int first_carried, carried;   ///< its nodes here: [first_carried, first_carried + carried) of LocalNetwork::carried
  double reach;                 ///< as of network::Body [m]
};

struct LocalCarried {
  LocalNode node;
  int body;   ///< index into LocalNetwork::bodies
  Vector3 offset;
};

/// The elements first .. last-1.
struct Range {
  int first;
  int last;
};

struct LocalPrescribed {
  LocalNode node;
  scene::Motion motion;
};

/// A point of the scene at a node that this rank speaks for.
struct LocalPoint {
  LocalNode node;
  scene::Point point;
};

struct LocalNetwork {
  int owned = 0;
  int ghosts = 0;
  int nodes = 0;                            ///< owned + ghosts + prescribed + carried
  SolverNumber first_number{0};             ///< of the first owned node
  int free_nodes = 0;                       ///< on all ranks together
  int interior = 0;                         ///< number of owned nodes that come before those of the interface
  Blocks blocks;                            ///< of all ranks, as in Partition
  Table<LocalNode, Unknown> begin;          ///< per owned node, and one past: its first unknown in this rank's vectors
  Interface interface;                      ///< of all ranks, as in Partition
  std::vector<SolverNumber> ghost_number;   ///< per ghost
  std::vector<int> ghost_owner;             ///< per ghost: the rank that owns it
  std::vector<int> ghost_index;             ///< per ghost: its index in `sent` of its owner
  std::vector<LocalNode> sent;              ///< owned nodes that are ghosts elsewhere
  Table<LocalNode, SceneNode> scene_node;
  Table<LocalNode, bool> primary;   ///< this rank speaks for the node; no other rank does
  /// First come the elements between owned nodes, then others that belong to this rank, then those of other ranks.
  std::vector<LocalElement> elements;
  int inner_elements = 0;                            ///< elements between owned nodes
  int own_elements = 0;                              ///< elements that belong to this rank
  Range attached{0, 0};                              ///< the elements at carried nodes, own ones first
  std::vector<int> scene_element;                    ///< per local element
  std::vector<network::NodeLoad<LocalNode>> loads;   ///< at nodes that this rank speaks for
  std::vector<LocalPoint> points;                    ///< on all ranks together, each of the scene's points once
  std::vector<LocalPrescribed> prescribed;
  std::vector<LocalBody> bodies;   ///< at owned nodes, then at ghosts
  int own_bodies = 0;
  bool has_euler_bodies = false;                 ///< on any rank
  std::vector<LocalCarried> carried;             ///< body after body
  std::vector<network::Link<LocalNode>> links;   ///< own ones first
  int own_links = 0;                             ///< links that belong to this rank, the owner of their free end
  std::vector<elements::CableMaterial> materials;
  network::Surroundings surroundings;
  std::vector<network::WetPoint<LocalNode>> wet_points;   ///< at nodes that this rank speaks for
  std::vector<network::BedSpot<LocalNode>> bed_spots;     ///< likewise
  double gravity = 0;                                     ///< [m/s^2] along -z
  /// Loads that depend on time are taken at this time, whatever the time is.  [s]
  std::optional<double> held_time;
  double extent = 0;                    ///< of the whole network as drawn, on all ranks alike [m]
  Table<LocalNode, Vector3> position;   ///< at the start [m]
  Table<LocalNode, Vector3> velocity;   ///< at the start [m/s]

  bool is_owned(LocalNode node) const { return node.value() < owned; }
  bool is_free(LocalNode node) const { return node.value() < owned + ghosts; }
  bool is_carried(LocalNode node) const { return node.value() >= nodes - static_cast<int>(carried.size()); }
  const LocalCarried& carried_at(LocalNode node) const { return carried[carried.size() - at(nodes - node.value())]; }
  /// The local node whose unknowns move this one.
  LocalNode anchor(LocalNode node) const { return is_carried(node) ? bodies[at(carried_at(node).body)].node : node; }
  /// The length of this rank's vectors.
  int unknowns() const { return begin.empty() ? 0 : begin[LocalNode(owned)].value(); }
  int all_unknowns() const { return blocks.begin(SolverNumber(free_nodes)); }
  /// The solver number of a free node.
  SolverNumber number(LocalNode node) const {
    return is_owned(node) ? first_number + node.value() : ghost_number[at(node.value() - owned)];
  }
};

LocalNetwork make_local_network(const network::Network& network, const Partition& partition, int rank);

}   // namespace cablenet::partition
