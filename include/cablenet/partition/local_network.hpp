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
  std::array<int, 2> node;    ///< local
  std::array<int, 2> place;   ///< of an owned node: its first unknown in this rank's vectors
  int material;
  double length;   ///< unstretched [m]
};

struct LocalBody {
  int node;   ///< local, owned or ghost
  int body;   ///< index into Network::bodies
  bodies::Properties properties;
  bodies::RotationState start;
  std::optional<bodies::BodyInWater> water;
  int first_carried, carried;   ///< its nodes here: [first_carried, first_carried + carried) of LocalNetwork::carried
};

struct LocalCarried {
  int node;   ///< local
  int body;   ///< index into LocalNetwork::bodies
  Vector3 offset;
};

/// Elements first .. last-1.
struct Range {
  int first;
  int last;
};

struct LocalPrescribed {
  int node;   ///< local
  scene::Motion motion;
};

struct LocalNetwork {
  int owned = 0;
  int ghosts = 0;
  int nodes = 0;                   ///< owned + ghosts + prescribed + carried
  int first_number = 0;            ///< solver number of the first owned node
  int free_nodes = 0;              ///< on all ranks together
  int interior = 0;                ///< owned nodes before those of the interface
  Blocks blocks;                   ///< of all ranks, as in Partition
  std::vector<int> begin;          ///< per owned node, and one past: its first unknown in this rank's vectors
  Interface interface;             ///< of all ranks, as in Partition
  std::vector<int> ghost_number;   ///< solver numbers of the ghosts
  std::vector<int> ghost_owner;    ///< rank
  std::vector<int> ghost_place;    ///< where it stands in its owner's `sent`
  std::vector<int> sent;           ///< owned nodes that are ghosts elsewhere
  std::vector<int> scene_node;     ///< per local node
  std::vector<bool> primary;       ///< per local node: this rank speaks for it
  /// First those between owned nodes, then the others that belong to this rank, then those that belong to another.
  std::vector<LocalElement> elements;
  int inner_elements = 0;                  ///< between owned nodes
  int own_elements = 0;                    ///< that belong to this rank
  Range attached{0, 0};                    ///< those at carried nodes, own ones first
  std::vector<int> scene_element;          ///< per local element
  std::vector<network::PointLoad> loads;   ///< at nodes that this rank speaks for; node is local
  std::vector<LocalPrescribed> prescribed;
  std::vector<LocalBody> bodies;   ///< at owned nodes, then at ghosts
  int own_bodies = 0;
  bool has_euler_bodies = false;       ///< on any rank
  std::vector<LocalCarried> carried;   ///< body after body
  std::vector<network::Link> links;    ///< nodes are local; own ones first
  int own_links = 0;                   ///< that belong to this rank: the owner of the free end's
  std::vector<elements::CableMaterial> materials;
  network::Surroundings surroundings;
  std::vector<network::WetPoint> wet_points;   ///< at nodes of this rank, or that its bodies carry; node is local
  double gravity = 0;                          ///< [m/s^2] along -z
  std::vector<Vector3> position;               ///< per local node, at the start [m]
  std::vector<Vector3> velocity;               ///< per local node, at the start [m/s]

  bool is_free(int local_node) const { return local_node < owned + ghosts; }
  bool is_carried(int local_node) const { return local_node >= nodes - static_cast<int>(carried.size()); }
  const LocalCarried& carried_at(int local_node) const {
    return carried[static_cast<std::size_t>(local_node - nodes) + carried.size()];
  }
  /// The local node whose unknowns move this one.
  int anchor(int local_node) const {
    return is_carried(local_node) ? bodies[static_cast<std::size_t>(carried_at(local_node).body)].node : local_node;
  }
  /// Of this rank's vectors.
  int unknowns() const { return begin.empty() ? 0 : begin.back(); }
  int all_unknowns() const { return blocks.begin(free_nodes); }
  /// Solver number of a free local node.
  int number(int local_node) const {
    return local_node < owned ? first_number + local_node : ghost_number[static_cast<std::size_t>(local_node - owned)];
  }
};

LocalNetwork make_local_network(const network::Network& network, const Partition& partition, int rank);

}   // namespace cablenet::partition
