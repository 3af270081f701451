#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cablenet/base/index.hpp"
#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/bodies/body_data.hpp"
#include "cablenet/elements/cable_data.hpp"
#include "cablenet/network/surroundings.hpp"
#include "cablenet/scene/scene.hpp"

/// The whole discretised network, in the scene's own numbering: points first, then the bodies' nodes, then the nets'
/// nodes, then each cable's inner nodes from end to end.  A body's nodes are its centre of gravity and those at its
/// attachments, at its centre of buoyancy and at its spots on the bed.  The network is the same on every rank, and
/// immutable once built.
namespace cablenet::network {

struct Element {
  std::array<SceneNode, 2> node;
  int material;    ///< index into Network::materials
  double length;   ///< unstretched [m]
};

/// A point mass and a constant force at a node.
template <class Node>
struct NodeLoad {
  Node node;
  double mass;     ///< [kg]
  Vector3 force;   ///< [N]
};

/// A node whose motion is given: it has no unknowns.
struct PrescribedNode {
  SceneNode node;
  scene::Motion motion;
};

/// A body.  The unknowns of its attitude follow the unknowns of its node.
struct Body {
  std::string name;
  SceneNode node;   ///< its centre of gravity; the mass is one of Network::loads
  bodies::Properties properties;
  bodies::RotationState start;                ///< attitude and angular velocity
  std::optional<bodies::BodyInWater> water;   ///< none where the scene has no fluid
  int first_carried = 0;   ///< Network::carried has its nodes: [first_carried, first_carried + carried)
  int carried = 0;
  /// The largest distance of an attachment from the centre of gravity, or the largest radius of gyration.  [m]
  double reach = 0;
};

/// A node that moves with a body and has no unknowns of its own: an attachment, the centre of buoyancy, or a spot that
/// touches the bed.
struct CarriedNode {
  SceneNode node;
  int body;         ///< index into Network::bodies
  Vector3 offset;   ///< r from the centre of gravity, body axes [m]
};

/// What ties a cable's end to an attachment r.  A spring pulls the two together by stiffness * distance.  The papers'
/// bar lies between the cable's end and the body's centre of gravity.  Its force F acts there and turns the body by
/// r x F, which together is the force F at the attachment.  Source: Tonin & Braun, CILAMCE 2020, eqs 19, 20.
template <class Node>
struct Link {
  std::array<Node, 2> node;   ///< the cable's end, the carried node
  double stiffness;           ///< EA/|r| [N/m]
  double bar_length = 0;      ///< of an unstretched bar, |r| [m]; 0: a spring

  bool is_bar() const { return bar_length > 0; }
};

/// The elements of a cable or a net: [first_element, first_element + elements).
struct Span {
  std::string name;
  int first_element;
  int elements;
};

/// A cable or a net whose unstretched lengths are to be found with the equilibrium, all by one factor.
struct Pretension {
  int span;   ///< index into Network::spans
  bool is_net;
  double tension;   ///< of a cable: what pulls at its first end; of a net: the mean over its twines [N]
};

struct Network {
  Table<SceneNode, Vector3> position;   ///< at the start [m]
  Table<SceneNode, Vector3> velocity;   ///< at the start [m/s]
  std::vector<Element> elements;        ///< cable after cable from end to end, then net after net
  std::vector<elements::CableMaterial> materials;
  std::vector<NodeLoad<SceneNode>> loads;
  std::vector<PrescribedNode> prescribed;   ///< held or moved nodes
  std::vector<Body> bodies;                 ///< in the scene's order
  std::vector<CarriedNode> carried;         ///< body after body
  std::vector<Link<SceneNode>> links;
  Surroundings surroundings;
  std::vector<WetPoint<SceneNode>> wet_points;
  std::vector<BedSpot<SceneNode>> bed_spots;
  std::vector<Span> spans;   ///< the scene's cables, then its nets
  std::vector<Pretension> pretensions;
  std::vector<scene::Point> points;    ///< the scene's
  std::vector<SceneNode> point_node;   ///< per scene point
  double gravity = 0;                  ///< [m/s^2] along -z

  /// The number of unknowns of all free nodes and bodies.
  std::int64_t unknowns() const;
  /// The diagonal of the smallest box, with sides along the axes, that holds all nodes as drawn.  [m]
  double extent() const;
  /// An index into `spans`: the cable or the net of an element.
  std::size_t span_at(int element) const;
  /// Names an element in messages: "trunk, element 3 of 24".
  std::string element_name(int element) const;
};

}   // namespace cablenet::network
