#pragma once
#include <mpi.h>

#include <string>
#include <utility>
#include <vector>

#include "cablenet/network/network.hpp"

/// What a user should know of an equilibrium: texts on the first rank, empty where there is nothing to say.  Tests:
/// tests/verification/slack_moorings.py
namespace cablenet::app {

/// Names the cables that push, those that push most first, and how much.  Bars may; a cable hardly can.  Collective.
/// @param here  this rank's elements that push, by their numbers in the scene, and how much [N]
std::string note_of_pushing(const network::Network& network, const std::vector<std::pair<int, double>>& here,
                            MPI_Comm communicator);

/// Names the cables that lie down over less than an element.  Collective.
/// @param here  this rank's elements on the bed, as StaticForces::on_bed() has them
std::string note_of_touchdown(const network::Network& network, const std::vector<std::pair<int, double>>& here,
                              MPI_Comm communicator);

}   // namespace cablenet::app
