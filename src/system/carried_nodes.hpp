#pragma once
#include <vector>

#include "cablenet/bodies/carried_data.hpp"
#include "cablenet/partition/local_network.hpp"

namespace cablenet::system {

/// What the tangent needs of the nodes that bodies carry: how they move, and where parts of their bodies' own blocks
/// are added until the bodies collect them.
struct CarriedNodes {
  explicit CarriedNodes(const partition::LocalNetwork& here)
      : network(here), tangents(here.carried.size()), blocks(at(here.own_bodies), bodies::BodyBlock::Zero()) {}

  /// nullptr for nodes that no body carries.
  bodies::CarriedTangent* tangent(LocalNode node) {
    return network.is_carried(node) ? &tangents[tangents.size() - at(network.nodes - node.value())] : nullptr;
  }
  /// Of this rank's body that carries both; nullptr where there is none.
  bodies::BodyBlock* shared_block(LocalNode one, LocalNode other) {
    if (!network.is_carried(one) || !network.is_carried(other)) return nullptr;
    const int body = network.carried_at(one).body;
    return body == network.carried_at(other).body && body < network.own_bodies ? &blocks[at(body)] : nullptr;
  }

  const partition::LocalNetwork& network;
  std::vector<bodies::CarriedTangent> tangents;   ///< as LocalNetwork::carried
  std::vector<bodies::BodyBlock> blocks;          ///< of this rank's bodies
};

}   // namespace cablenet::system
