#pragma once
#include <vector>

#include "cablenet/network/network.hpp"
#include "cablenet/scene/scene.hpp"

namespace cablenet::network {

/// Per body and attachment of the scene: the node at which the attachment's cables end; none where no cable ends.
using AttachmentNodes = std::vector<std::vector<SceneNode>>;

/// Adds the scene's bodies.  Each body gets a node, and nodes for the attachments that cables use.
AttachmentNodes add_bodies(const scene::Scene& scene, Network& network);

}   // namespace cablenet::network
