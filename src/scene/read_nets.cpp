#include <fmt/format.h>

#include <algorithm>

#include "parts.hpp"

namespace cablenet::scene {

namespace {

std::array<Vector3, 4> read_corners(const Value& value) {
  const std::string expected = "four corners [[x, y, z], ...] [m] in order round the panel";
  const std::vector<Value> rows = read_list(value, expected);
  if (rows.size() != 4) value.refuse(expected, "Write exactly 4.");
  std::array<Vector3, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    corners[i] = read_vector(rows[i], "m");
    for (std::size_t j = 0; j < i; ++j)
      if (corners[i] == corners[j])
        rows[i].fail(fmt::format("corners {} and {} coincide; expected four places. Move one.", j + 1, i + 1));
  }
  return corners;
}

std::vector<Edge> read_fixed(const Value& value) {
  const Edge edges[] = {Edge::top, Edge::right, Edge::bottom, Edge::left};
  std::vector<Edge> fixed;
  for (const Value& item : read_list(value, "a list of: top, right, bottom, left")) {
    const Edge edge = edges[read_choice(item, {"top", "right", "bottom", "left"})];
    if (std::find(fixed.begin(), fixed.end(), edge) == fixed.end()) fixed.push_back(edge);
  }
  return fixed;
}

Net read_net(const Named& named, const Names& types) {
  const Section section(named.value, {"type", "corners", "meshes", "slack", "fixed"});
  Net net;
  net.name = named.name;
  net.where = named.value.where();
  const Value& type = section.require("type", "the name of a cable type");
  net.type = types.one(type, read_text(type, "the name of a cable type"));
  net.corners = read_corners(section.require("corners", "four corners [[x, y, z], ...] [m]"));
  const Value& meshes = section.require("meshes", "[nx, ny], two integers >= 1");
  const std::vector<Value> counts = read_list(meshes, "[nx, ny], two integers >= 1");
  if (counts.size() != 2) meshes.refuse("[nx, ny], two integers >= 1", "Write exactly 2.");
  net.meshes = {read_integer(counts[0], 1), read_integer(counts[1], 1)};
  if (const Value* slack = section.find("slack")) net.slack = read_number(*slack, Sign::positive, "");
  if (const Value* fixed = section.find("fixed")) net.fixed = read_fixed(*fixed);
  return net;
}

}   // namespace

std::vector<Net> read_nets(const Section& top, const Names& types, Names& names) {
  std::vector<Net> nets;
  const Value* value = top.find("nets");
  if (value == nullptr) return nets;
  for (const Named& named : read_named(*value, "a map from names to nets")) {
    names.add(named.name, static_cast<int>(nets.size()), 0);
    nets.push_back(read_net(named, types));
  }
  return nets;
}

}   // namespace cablenet::scene
