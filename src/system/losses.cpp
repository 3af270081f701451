#include "cablenet/system/losses.hpp"

#include <algorithm>

namespace cablenet::system {

bool is_damped(const elements::CableMaterial& material) {
  return material.axial_damping > 0 || material.mass_damping > 0;
}

bool only_formulas_take_energy(const partition::LocalNetwork& network, MPI_Comm communicator) {
  const auto loses = [&](const partition::LocalElement& e) { return is_damped(network.materials[at(e.material)]); };
  const auto is_bar = [](const auto& link) { return link.is_bar(); };
  const auto is_slowed = [](const partition::LocalBody& body) {
    return !body.properties.linear_drag.isZero(0) || !body.properties.quadratic_drag.isZero(0);
  };
  int others = network.surroundings.fluid || network.surroundings.bed ||
               std::any_of(network.elements.begin(), network.elements.end(), loses) ||
               std::any_of(network.links.begin(), network.links.end(), is_bar) ||
               std::any_of(network.bodies.begin(), network.bodies.end(), is_slowed);
  MPI_Allreduce(MPI_IN_PLACE, &others, 1, MPI_INT, MPI_MAX, communicator);
  return others == 0;
}

}   // namespace cablenet::system
