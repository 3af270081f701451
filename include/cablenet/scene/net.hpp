#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/scene/choice.hpp"

namespace cablenet::scene {

enum class Edge { top, right, bottom, left };
template <>
inline constexpr std::array<Choice<Edge>, 4> choices<Edge>{
    {{Edge::top, "top"}, {Edge::right, "right"}, {Edge::bottom, "bottom"}, {Edge::left, "left"}}};

struct Net {
  std::string name;
  std::string where;   ///< "file:line" for messages
  int type = 0;
  std::array<Vector3, 4> corners;    ///< in order round the panel; top joins corners 0 and 1, right 1 and 2, ...
  std::array<int, 2> meshes{};       ///< along the first edge (corners 0-1) and the second (1-2)
  double slack = 1;                  ///< unstretched length / drawn length
  std::optional<double> prestress;   ///< mean tension in the equilibrium [N], by which the slack is found
  std::vector<Edge> fixed;
};

}   // namespace cablenet::scene
