#pragma once
#include <vector>

#include "cablenet/network/network.hpp"
#include "cablenet/scene/scene.hpp"

namespace cablenet::network {

/// Per body and attachment of the scene: the node at which its cables end; none where no cable does.
using AttachmentNodes = std::vector<std::vector<SceneNode>>;

/// Adds the scene's bodies, with a node for each and for every attachment in use.
AttachmentNodes add_bodies(const scene::Scene& scene, Network& network);

}   // namespace cablenet::network
