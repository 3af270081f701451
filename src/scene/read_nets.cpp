#include <fmt/format.h>

#include <algorithm>

#include "parts.hpp"
#include "rows.hpp"

namespace cablenet::scene {

namespace {

using Corners = std::array<Vector3, 4>;
const std::string corners_expected = "four corners [[x, y, z], ...] [m] in order round the panel";
const std::string edges_expected = "a list of: top, right, bottom, left";

Corners read_corners(const Value& value) {
  const std::vector<Value> rows = read_list(value, corners_expected);
  if (rows.size() != 4) value.refuse(corners_expected, "Write exactly 4.");
  Corners corners;
  for (std::size_t i = 0; i < 4; ++i) {
    corners[i] = read_vector(rows[i], "m");
    for (std::size_t j = 0; j < i; ++j)
      if (corners[i] == corners[j])
        rows[i].fail(fmt::format("corners {} and {} coincide; expected four places. Move one.", j + 1, i + 1));
  }
  return corners;
}

Kind<Corners> corners() {
  const Form corner = vector("m").form;
  return {{corners_expected, TupleForm{{corner, corner, corner, corner}}}, read_corners, nullptr};
}

std::vector<Edge> read_edges(const Value& value) {
  std::vector<Edge> edges;
  for (const Value& item : read_list(value, edges_expected)) {
    const Edge edge = choice<Edge>().read(item);
    if (std::find(edges.begin(), edges.end(), edge) == edges.end()) edges.push_back(edge);
  }
  return edges;
}

struct NetKeys : Net {
  std::optional<Value> given_type;
};
const Table<NetKeys> net_table(
    "A panel of square meshes, each side of a mesh one element.",
    {{"type", later(text("the name of a cable type").form), required, "What the twines are made of.",
      &NetKeys::given_type},
     {"corners", corners(), required, "The corners of the panel in order round it.", &NetKeys::corners},
     {"meshes", integer_pair("[nx, ny]", 1), required,
      "How many meshes there are along the first edge (corners 1 to 2) and the second (2 to 3).", &NetKeys::meshes},
     {"slack", number("", above(0)), standard, "The unstretched length over the drawn length.", &NetKeys::slack},
     {"prestress", number("N", above(0)), absent("slack holds"),
      "Instead of slack: the mean tension of the twines, by length, in the equilibrium; the slack is found by it.",
      &NetKeys::prestress},
     {"fixed", Kind<std::vector<Edge>>{list_form(edges_expected, choice<Edge>().form), read_edges, nullptr},
      absent("none"), "The edges that are held; top joins corners 1 and 2, right 2 and 3, and so on.",
      &NetKeys::fixed}});

Net read_net(const Named& named, const Names& types) {
  NetKeys net;
  const Section section = read_rows(named.value, net_table, net);
  if (net.prestress && section.find("slack") != nullptr)
    section.find("prestress")->refuse("no prestress beside slack, as the slack is found by it", "Remove one of them.");
  net.name = named.name;
  net.where = named.value.where();
  net.type = types.one(*net.given_type, read_text(*net.given_type, "the name of a cable type"));
  return net;
}

}   // namespace

Form nets_form() { return map_form("a map from names to nets", section_form(net_table)); }

std::vector<Net> read_nets(const Value& value, const Names& types, Names& names) {
  std::vector<Net> nets;
  for (const Named& named : read_named(value, nets_form().expected)) {
    names.add(named.name, static_cast<int>(nets.size()), 0);
    nets.push_back(read_net(named, types));
  }
  return nets;
}

}   // namespace cablenet::scene
