#pragma once
#include <ostream>
#include <string>
#include <vector>

/// The tests share these small scenes, one of each kind of network.
namespace cablenet::test {

inline const std::string chain = R"(
points: {a: {position: [0, 0, 0], motion: fixed}, b: {position: [20, 0, 0], mass: 2}}
cables: {chain: {type: rope, from: a, to: b, elements: 20}}
)";

inline const std::string array = R"(
points:
  tow: {position: [0, 0, 0], motion: {velocity: [1, 0, 0]}, mass: 1}
  tail: {position: [30, 0, 0]}
  tip: {position: [5, 0, -4], mass: 1}
cables:
  trunk: {type: rope, from: tow, to: tail, elements: 30}
  branch: {type: rope, from: {cable: trunk, at: 5}, to: tip, elements: 4, repeat: {count: 5, every: 5, offset: [5, 0, 0]}}
)";

inline const std::string two_cables = R"(
points:
  a: {position: [0, 0, 0], motion: fixed}
  b: {position: [9, 0, 0]}
  c: {position: [0, 5, 0]}
  d: {position: [0, 9, 0], force: [0, 1, 0]}
cables: {one: {type: rope, from: a, to: b, elements: 9}, other: {type: rope, from: c, to: d, elements: 7}}
)";

inline const std::string net = R"(
points: {end: {position: [3, 0, -9], mass: 4}}
cables: {hanger: {type: rope, from: {net: panel, node: [3, 4]}, to: end, elements: 5}}
nets: {panel: {type: rope, corners: [[0, 0, 0], [6, 0, 0], [6, 0, -4], [0, 0, -4]], meshes: [6, 4], fixed: [top, left]}}
)";

inline const std::string one_free_node = R"(
points:
  a: {position: [0, 0, 0], motion: fixed, mass: 3}
  b: {position: [2, 0, 0], motion: fixed}
cables: {c: {type: rope, from: a, to: b, elements: 2}}
)";

/// Every free node lies alone between two held ones, so the graph of free nodes has no edges.
inline const std::string no_edges = R"(
points:
  a: {position: [0, 0, 0], motion: fixed}
  b: {position: [2, 0, 0], motion: fixed}
  c: {position: [2, 2, 0], motion: fixed}
  d: {position: [0, 2, 0], motion: fixed}
cables:
  ab: {type: rope, from: a, to: b, elements: 2}
  bc: {type: rope, from: b, to: c, elements: 2}
  cd: {type: rope, from: c, to: d, elements: 2}
  da: {type: rope, from: d, to: a, elements: 2}
  ac: {type: rope, from: a, to: c, elements: 2}
)";

/// Two cables join the same two nodes, and one cable has no free node.
inline const std::string doubled = R"(
points:
  a: {position: [0, 0, 0], motion: fixed}
  b: {position: [2, 0, 0], motion: fixed}
  c: {position: [4, 0, 0]}
  d: {position: [6, 0, 0]}
cables:
  held: {type: rope, from: a, to: b, elements: 1}
  bc: {type: rope, from: b, to: c, elements: 1}
  cd: {type: rope, from: c, to: d, elements: 1}
  dc: {type: rope, from: d, to: c, elements: 1}
)";

struct NamedScene {
  std::string name;
  std::string text;
  friend void PrintTo(const NamedScene& scene, std::ostream* out) { *out << scene.name; }
};

inline const std::vector<NamedScene> kinds_of_networks{
    {"chain", chain},
    {"array", array},
    {"two_cables", two_cables},
    {"net", net},
    {"one_free_node", one_free_node},
    {"no_edges", no_edges},
    {"doubled", doubled},
};

}   // namespace cablenet::test
