#include <fmt/format.h>

#include <algorithm>

#include "parts.hpp"
#include "rows.hpp"

namespace cablenet::scene {

namespace {

const char* const end_expected =
    "a point's name, BODY.ATTACHMENT, {cable: NAME, at: s [m]} or {net: NAME, node: [i, j]}";

struct ReferenceKeys {
  std::optional<std::string> cable, net;
  std::optional<double> at;
  std::optional<std::array<int, 2>> node;
};
const Table<ReferenceKeys> reference_table(
    "A cable's end on another cable, which gets a node there, or at a node of a net.",
    {{"cable", text("a cable's name"), absent("a net is given"), "The other cable.", &ReferenceKeys::cable},
     {"at", number("m", at_least(0)), absent("a net is given"), "The unstretched length from that cable's start.",
      &ReferenceKeys::at},
     {"net", text("a net's name"), absent("a cable is given"), "The net.", &ReferenceKeys::net},
     {"node", integer_pair("[i, j]", 0), absent("a cable is given"),
      "The node, counted from the net's first corner along its first and second edge.", &ReferenceKeys::node}});

Reference read_reference(const Value& value) {
  if (value.node.IsScalar()) return {Reference::Target::named, value.node.Scalar(), 0, {}, value};
  if (!value.node.IsMap()) value.refuse(end_expected, "Write one of these.");
  ReferenceKeys keys;
  const Section section = read_rows(value, reference_table, keys);
  const bool is_mixed = keys.cable ? keys.node.has_value() : keys.at.has_value();
  if (keys.cable.has_value() == keys.net.has_value() || is_mixed)
    value.refuse(end_expected, "Give either cable and at, or net and node.");
  section.require(keys.cable ? "at" : "node");
  if (keys.cable) return {Reference::Target::cable, *keys.cable, *keys.at, {}, value};
  return {Reference::Target::net, *keys.net, 0, *keys.node, value};
}

Kind<Reference> reference() {
  return {either_form(end_expected, {text("a point's name or BODY.ATTACHMENT").form, section_form(reference_table)}),
          read_reference, nullptr};
}

const std::string shape_expected = "straight, catenary or a polyline [[x, y, z], ...]";

Form shape_form() {
  const Form polyline = list_form("a list of at least 2 rows [x, y, z] [m]", vector("m").form, 2);
  return either_form(shape_expected, {choice<Shape>().form, polyline});
}

void check_polyline(const Value& value, const Cable& cable) {
  const auto& points = cable.polyline;
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double piece = (points[i] - points[i - 1]).norm();
    length += piece;
    if (piece == 0 && cable.elements > 0 && points.size() == static_cast<std::size_t>(cable.elements) + 1)
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
  const auto is_same = [&](const Choice<Shape>& word) { return value.node.Scalar() == word.name; };
  const auto found = std::find_if(choices<Shape>.begin(), choices<Shape>.end(), is_same);
  if (!value.node.IsScalar() || found == choices<Shape>.end()) value.refuse(shape_expected, "Write one of these.");
  cable.shape = found->value;
}

void read_node_velocity(const Value& value, Cable& cable) {
  if (cable.elements == 0) {
    cable.node_velocity = read_vectors(value, 2, "m/s");
    return;
  }
  const auto rows = static_cast<std::size_t>(cable.elements) + 1;
  const std::string expected = fmt::format("a list of {} rows [u, v, w] [m/s], one per node (elements + 1)", rows);
  if (read_list(value, expected).size() != rows) value.refuse(expected, "Correct the rows or elements.");
  cable.node_velocity = read_vectors(value, rows, "m/s");
}

const Table<Repeat> repeat_table(
    "Copies of a cable that ends on another one; the point or body at its other end is copied with it.",
    {{"count", integer(1), required, "How many there are in all; they are called NAME[0], NAME[1], ...",
      &Repeat::count},
     {"every", number("m"), required, "The unstretched length of the other cable from one to the next.",
      &Repeat::every},
     {"offset", vector("m"), required, "From one copy to the next, as drawn.", &Repeat::offset}});

Repeat read_repeat(const Value& value) {
  Repeat repeat{0, 0, Vector3::Zero(), value};
  read_rows(value, repeat_table, repeat);
  return repeat;
}

/// Shape and node velocities depend on the number of elements.
struct CableKeys : Cable {
  std::optional<Value> given_type, given_shape, given_velocity;
  std::optional<Reference> from_name, to_name;
  std::optional<Repeat> repeat;
};
const Table<CableKeys> cable_table(
    "A cable from one place to another.",
    {{"type", later(text("the name of a cable type").form), required, "What the cable is made of.",
      &CableKeys::given_type},
     {"from", reference(), required, "Where the cable starts.", &CableKeys::from_name},
     {"to", reference(), required, "Where the cable ends.", &CableKeys::to_name},
     {"length", number("m", above(0)), absent("the distance between the drawn ends, unless tension is given"),
      "The unstretched length.", &CableKeys::length},
     {"tension", number("N", above(0)), absent("length holds"),
      "Instead of length: what pulls at `from` in the equilibrium; the unstretched length is found by it.",
      &CableKeys::tension},
     {"elements", integer(1), absent("required without accuracy, which chooses them"),
      "How many elements the cable is divided into.", &CableKeys::elements},
     {"shape", later(shape_form()), absent("straight"),
      "How the cable is drawn: straight; catenary, as it hangs without stretch, upwards where it floats, and lying on "
      "the "
      "bed or afloat where it reaches that; or along a polyline, evenly by length, or at its points where it has "
      "elements + 1.",
      &CableKeys::given_shape},
     {"node_velocity",
      later(list_form("a list of rows [u, v, w] [m/s], one per node (elements + 1); evenly from end to end where "
                      "elements are absent",
                      vector("m/s").form, 2)),
      absent("linear between the velocities of the ends"), "The velocity of each node at the start.",
      &CableKeys::given_velocity},
     {"repeat", Kind<Repeat>{section_form(repeat_table), read_repeat, nullptr}, absent("one cable"),
      "Copies of the cable.", &CableKeys::repeat}});

CableDraft read_cable(const Named& named, const Scene& scene, const Names& types) {
  CableKeys cable;
  const Section section = read_rows(named.value, cable_table, cable);
  if (!scene.accuracy) section.require("elements", ", as there is no accuracy by which they are chosen");
  if (cable.length && cable.tension)
    section.find("tension")->refuse("no tension beside length, as the length is found by it", "Remove one of them.");
  cable.name = named.name;
  cable.where = named.value.where();
  cable.type = types.one(*cable.given_type, read_text(*cable.given_type, "the name of a cable type"));
  if (cable.given_shape) read_shape(*cable.given_shape, cable);
  if (cable.given_velocity) read_node_velocity(*cable.given_velocity, cable);
  return {cable, *cable.from_name, *cable.to_name, cable.repeat, named.value};
}

}   // namespace

Form cables_form() { return map_form("a map from names to cables", section_form(cable_table)); }

std::vector<CableDraft> read_cables(const Value& value, const Scene& scene, const Names& types) {
  std::vector<CableDraft> cables;
  for (const Named& named : read_named(value, cables_form().expected))
    cables.push_back(read_cable(named, scene, types));
  return cables;
}

}   // namespace cablenet::scene
