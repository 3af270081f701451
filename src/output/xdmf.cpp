#include "xdmf.hpp"

#include <fmt/format.h>

namespace cablenet::output {
namespace {

constexpr std::string_view real = R"(NumberType="Float" Precision="8")";
constexpr std::string_view integer = R"(NumberType="Int" Precision="4")";

// Without Precision="8" the readers take doubles for floats.
std::string data_item(std::string_view type, const std::string& shape, const std::string& address) {
  return fmt::format(R"(<DataItem Format="HDF" {} Dimensions="{}">{}</DataItem>)", type, shape, address);
}

std::string attribute(std::string_view name, std::string_view kind, std::string_view center, const std::string& item) {
  return fmt::format(R"(  <Attribute Name="{}" AttributeType="{}" Center="{}">{}</Attribute>)"
                     "\n",
                     name, kind, center, item);
}

}   // namespace

const std::string_view xdmf_head =
    R"(<?xml version="1.0" ?><!DOCTYPE Xdmf SYSTEM "Xdmf.dtd" []>
<Xdmf Version="3.0"><Domain><Grid Name="cables" GridType="Collection" CollectionType="Temporal">
)";
const std::string_view xdmf_tail = "</Grid></Domain></Xdmf>\n";

std::string xdmf_step(double time, std::int64_t nodes, std::int64_t elements, std::string_view group) {
  const auto n = fmt::to_string(nodes);
  const auto m = fmt::to_string(elements);
  const auto in_frame = [&](const char* name) { return fmt::format("{}/{}", group, name); };
  std::string text = fmt::format(R"( <Grid Name="cables" GridType="Uniform"><Time Value="{:.17g}"/>)"
                                 "\n",
                                 time);
  // The mesh is named again in each step: Xdmf3 aborts ParaView on references.
  text += fmt::format(R"(  <Topology TopologyType="Polyline" NodesPerElement="2" NumberOfElements="{}">{}</Topology>)"
                      "\n",
                      m, data_item(integer, m + " 2", "mesh.h5:/mesh/lines"));
  text += fmt::format(R"(  <Geometry GeometryType="XYZ">{}</Geometry>)"
                      "\n",
                      data_item(real, n + " 3", in_frame("points")));
  text += attribute("velocity", "Vector", "Node", data_item(real, n + " 3", in_frame("velocity")));
  text += attribute("tension_node", "Scalar", "Node", data_item(real, n, in_frame("tension_node")));
  text += attribute("tension", "Scalar", "Cell", data_item(real, m, in_frame("tension")));
  text += attribute("strain", "Scalar", "Cell", data_item(real, m, in_frame("strain")));
  text += attribute("cable_id", "Scalar", "Cell", data_item(integer, m, "mesh.h5:/mesh/cable_id"));
  text += attribute("rank", "Scalar", "Cell", data_item(integer, m, "mesh.h5:/mesh/rank"));
  return text + " </Grid>\n";
}

}   // namespace cablenet::output
