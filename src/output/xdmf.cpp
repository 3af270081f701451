#include "xdmf.hpp"

#include <fmt/format.h>

namespace cablenet::output {
namespace {

constexpr std::string_view real = R"(NumberType="Float" Precision="8")";
constexpr std::string_view integer = R"(NumberType="Int" Precision="4")";

// Without Precision="8" in `real` the readers take doubles for floats.
std::string data_item(std::string_view type, const std::string& shape, const std::string& address) {
  return fmt::format(R"(<DataItem Format="HDF" {} Dimensions="{}">{}</DataItem>)", type, shape, address);
}

std::string attribute(std::string_view name, std::string_view kind, std::string_view center, const std::string& item) {
  return fmt::format(R"(  <Attribute Name="{}" AttributeType="{}" Center="{}">{}</Attribute>)"
                     "\n",
                     name, kind, center, item);
}

std::string step_head(std::string_view name, double time) {
  return fmt::format(R"( <Grid Name="{}" GridType="Uniform"><Time Value="{:.17g}"/>)"
                     "\n",
                     name, time);
}

// The mesh is named again in each step: Xdmf3 aborts ParaView on references.
std::string topology(std::string_view type, int nodes_each, const std::string& cells, const std::string& address) {
  return fmt::format(R"(  <Topology TopologyType="{}" NodesPerElement="{}" NumberOfElements="{}">{}</Topology>)"
                     "\n",
                     type, nodes_each, cells, data_item(integer, fmt::format("{} {}", cells, nodes_each), address));
}

std::string geometry(const std::string& nodes, const std::string& address) {
  return fmt::format(R"(  <Geometry GeometryType="XYZ">{}</Geometry>)"
                     "\n",
                     data_item(real, nodes + " 3", address));
}

}   // namespace

std::string xdmf_head(std::string_view name) {
  return fmt::format(R"(<?xml version="1.0" ?><!DOCTYPE Xdmf SYSTEM "Xdmf.dtd" []>
<Xdmf Version="3.0"><Domain><Grid Name="{}" GridType="Collection" CollectionType="Temporal">
)",
                     name);
}

const std::string_view xdmf_tail = "</Grid></Domain></Xdmf>\n";

std::string xdmf_cables(double time, std::int64_t nodes, std::int64_t elements, std::string_view group) {
  const auto n = fmt::to_string(nodes);
  const auto m = fmt::to_string(elements);
  const auto in_frame = [&](const char* name) { return fmt::format("{}/{}", group, name); };
  std::string text = step_head("cables", time);
  text += topology("Polyline", 2, m, "mesh.h5:/mesh/lines");
  text += geometry(n, in_frame("points"));
  text += attribute("velocity", "Vector", "Node", data_item(real, n + " 3", in_frame("velocity")));
  text += attribute("tension_node", "Scalar", "Node", data_item(real, n, in_frame("tension_node")));
  text += attribute("tension", "Scalar", "Cell", data_item(real, m, in_frame("tension")));
  text += attribute("strain", "Scalar", "Cell", data_item(real, m, in_frame("strain")));
  text += attribute("cable_id", "Scalar", "Cell", data_item(integer, m, "mesh.h5:/mesh/cable_id"));
  text += attribute("rank", "Scalar", "Cell", data_item(integer, m, "mesh.h5:/mesh/rank"));
  return text + " </Grid>\n";
}

std::string xdmf_bodies(double time, std::int64_t bodies, std::string_view group) {
  const auto b = fmt::to_string(bodies);
  const auto in_frame = [&](const char* name) { return fmt::format("{}/body_{}", group, name); };
  const std::string vertices = "mesh.h5:/mesh/body_vertices";
  std::string text = step_head("bodies", time);
  text += topology("Polyvertex", 1, b, vertices);
  text += geometry(b, in_frame("position"));
  const auto at_nodes = [&](const char* name, const char* kind, const std::string& item) {
    text += attribute(name, kind, "Node", item);
  };
  at_nodes("velocity", "Vector", data_item(real, b + " 3", in_frame("velocity")));
  at_nodes("angular_velocity", "Vector", data_item(real, b + " 3", in_frame("angular_velocity")));
  // The readers keep only three components of a "Vector".
  at_nodes("quaternion", "Matrix", data_item(real, b + " 4", in_frame("quaternion")));
  at_nodes("body_id", "Scalar", data_item(integer, b + " 1", vertices));
  at_nodes("box", "Vector", data_item(real, b + " 3", "mesh.h5:/mesh/body_box"));
  at_nodes("box_attitude", "Matrix", data_item(real, b + " 4", "mesh.h5:/mesh/body_box_attitude"));
  return text + " </Grid>\n";
}

}   // namespace cablenet::output
