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

  const bodies::CarriedTangent& tangent(LocalNode node) const {
    return tangents[at(node.value() - network.nodes + static_cast<int>(tangents.size()))];
  }
  /// Of the body that carries the node; nullptr for another rank's body.
  bodies::BodyBlock* block(LocalNode node) {
    const int body = network.carried_at(node).body;
    return body < network.own_bodies ? &blocks[at(body)] : nullptr;
  }

  const partition::LocalNetwork& network;
  std::vector<bodies::CarriedTangent> tangents;   ///< as LocalNetwork::carried
  std::vector<bodies::BodyBlock> blocks;          ///< of this rank's bodies
};

}   // namespace cablenet::system
