#include <fmt/format.h>

#include "parts.hpp"

namespace cablenet::scene {

namespace {

const char* const end_expected =
    "a point's name, BODY.ATTACHMENT, {cable: NAME, at: s [m]} or {net: NAME, node: [i, j]}";

Reference read_reference(const Value& value) {
  if (value.node.IsScalar()) return {Reference::Kind::named, value.node.Scalar(), 0, {}, value};
  if (!value.node.IsMap()) value.refuse(end_expected, "Write one of these.");
  const Section section(value, {"cable", "at", "net", "node"});
  const Value* cable = section.find("cable");
  const Value* net = section.find("net");
  const Value* mixed = section.find(cable != nullptr ? "node" : "at");
  if ((cable == nullptr) == (net == nullptr) || mixed != nullptr)
    value.refuse(end_expected, "Give either cable and at, or net and node.");
  if (cable != nullptr) {
    const double at = read_number(section.require("at", "a number >= 0 [m]"), Sign::not_negative, "m");
    return {Reference::Kind::cable, read_text(*cable, "a cable's name"), at, {}, value};
  }
  const Value& node = section.require("node", "[i, j], two integers >= 0");
  const std::vector<Value> items = read_list(node, "[i, j], two integers >= 0");
  if (items.size() != 2) node.refuse("[i, j], two integers >= 0", "Write exactly 2.");
  return {Reference::Kind::net,
          read_text(*net, "a net's name"),
          0,
          {read_integer(items[0], 0), read_integer(items[1], 0)},
          value};
}

void check_polyline(const Value& value, const Cable& cable) {
  const auto& points = cable.polyline;
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double piece = (points[i] - points[i - 1]).norm();
    length += piece;
    if (piece == 0 && points.size() == static_cast<std::size_t>(cable.elements) + 1)
      value.fail(
          fmt::format("rows {} and {} coincide, and each row is a node here; expected elements of some length. "
                      "Move or remove one.",
                      i - 1, i));
  }
  if (length == 0) value.fail("all rows coincide; expected a line of some length. Move them apart.");
}

void read_shape(const Value& value, Cable& cable) {
  if (value.node.IsSequence()) {
    cable.shape = Shape::polyline;
    cable.polyline = read_vectors(value, 2, "m");
    check_polyline(value, cable);
    return;
  }
  const std::string expected = "straight, catenary or a polyline [[x, y, z], ...]";
  if (!value.node.IsScalar()) value.refuse(expected, "Write one of these.");
  if (value.node.Scalar() != "straight" && value.node.Scalar() != "catenary")
    value.refuse(expected, "Write one of these.");
  cable.shape = value.node.Scalar() == "straight" ? Shape::straight : Shape::catenary;
}

void read_node_velocity(const Value& value, Cable& cable) {
  const auto rows = static_cast<std::size_t>(cable.elements) + 1;
  const std::string expected = fmt::format("a list of {} rows [u, v, w] [m/s], one per node (elements + 1)", rows);
  if (read_list(value, expected).size() != rows) value.refuse(expected, "Correct the rows or elements.");
  cable.node_velocity = read_vectors(value, rows, "m/s");
}

Repeat read_repeat(const Value& value) {
  const Section section(value, {"count", "every", "offset"});
  const int count = read_integer(section.require("count", "an integer >= 1"), 1);
  const double every = read_number(section.require("every", "a number [m]"), Sign::any, "m");
  const Vector3 offset = read_vector(section.require("offset", "[x, y, z], three numbers [m]"), "m");
  return {count, every, offset, value};
}

CableDraft read_cable(const Named& named, const Names& types) {
  const Section section(named.value, {"type", "from", "to", "length", "elements", "shape", "node_velocity", "repeat"});
  Cable cable;
  cable.name = named.name;
  cable.where = named.value.where();
  const Value& type = section.require("type", "the name of a cable type");
  cable.type = types.one(type, read_text(type, "the name of a cable type"));
  const Reference from = read_reference(section.require("from", end_expected));
  const Reference to = read_reference(section.require("to", end_expected));
  if (const Value* length = section.find("length")) cable.length = read_number(*length, Sign::positive, "m");
  cable.elements = read_integer(section.require("elements", "an integer >= 1"), 1);
  if (const Value* shape = section.find("shape")) read_shape(*shape, cable);
  if (const Value* rows = section.find("node_velocity")) read_node_velocity(*rows, cable);
  std::optional<Repeat> repeat;
  if (const Value* value = section.find("repeat")) repeat.emplace(read_repeat(*value));
  return {std::move(cable), from, to, std::move(repeat), named.value};
}

}   // namespace

std::vector<CableDraft> read_cables(const Section& top, const Names& types) {
  std::vector<CableDraft> cables;
  const Value* value = top.find("cables");
  if (value == nullptr) return cables;
  for (const Named& named : read_named(*value, "a map from names to cables"))
    cables.push_back(read_cable(named, types));
  return cables;
}

}   // namespace cablenet::scene
