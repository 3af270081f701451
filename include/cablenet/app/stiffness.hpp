#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "cablenet/network/network.hpp"
#include "cablenet/scene/scene.hpp"
#include "cablenet/system/assembler.hpp"

/// The stiffness in an equilibrium that `output.stiffness` asks for.  solve/condensed_stiffness.hpp says what it is.
/// Tests: tests/verification/stiffness.py
namespace cablenet::app {

struct NamedStiffness {
  std::string name;
  Eigen::MatrixXd matrix;   ///< empty where it is not defined
};

/// Of each point and body that the scene asks for.  Collective.
/// @param assembler  whose start is an equilibrium in the frame of this velocity [m/s]
std::vector<NamedStiffness> find_stiffness(const scene::Scene& scene, const network::Network& network,
                                           const system::Assembler& assembler, const Vector3& velocity);

/// A line for each row of each matrix: name, what responds, and the response to each motion.
std::string stiffness_table(const std::vector<NamedStiffness>& all);

/// Names those that have none; empty where all have one.
std::string note_of_stiffness(const std::vector<NamedStiffness>& all);

}   // namespace cablenet::app
