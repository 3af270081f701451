#include "cablenet/app/stiffness.hpp"

#include <fmt/format.h>

#include <iterator>

#include "cablenet/solve/condensed_stiffness.hpp"

namespace cablenet::app {
namespace {

constexpr const char* responses[] = {"fx", "fy", "fz", "mx", "my", "mz"};

}   // namespace

std::vector<NamedStiffness> find_stiffness(const scene::Scene& scene, const network::Network& network,
                                           const system::Assembler& assembler, const Vector3& velocity) {
  std::vector<NamedStiffness> all;
  std::vector<SceneNode> nodes;
  for (const auto& [kind, index] : scene.output.stiffness) {
    const bool is_point = kind == scene::HistoryKind::point;
    all.push_back({is_point ? scene.points[at(index)].name : scene.bodies[at(index)].name, {}});
    nodes.push_back(is_point ? network.point_node[at(index)] : network.bodies[at(index)].node);
  }
  if (nodes.empty()) return all;
  solve::CondensedStiffness stiffness(solve::at_start_of(network, assembler), nodes, assembler.rule(), scene.time.start,
                                      velocity, assembler.communicator());
  for (std::size_t i = 0; i < nodes.size(); ++i) all[i].matrix = stiffness.of(nodes[i]).value_or(Eigen::MatrixXd());
  return all;
}

std::string stiffness_table(const std::vector<NamedStiffness>& all) {
  std::string text = "name,response,x,y,z,rx,ry,rz\n";
  for (const auto& [name, matrix] : all)
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      fmt::format_to(std::back_inserter(text), "{},{}", name, responses[i]);
      for (Eigen::Index j = 0; j < 6; ++j) text += j < matrix.cols() ? fmt::format(",{:.17g}", matrix(i, j)) : ",";
      text += "\n";
    }
  return text;
}

std::string note_of_stiffness(const std::vector<NamedStiffness>& all) {
  std::string names;
  for (const auto& [name, matrix] : all)
    if (matrix.size() == 0) names += (names.empty() ? "" : ", ") + name;
  if (names.empty()) return {};
  return fmt::format(
      "there is no stiffness of {}: with it held, a part of the network can still move without any force; hold that "
      "part",
      names);
}

}   // namespace cablenet::app
