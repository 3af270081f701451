#pragma once
#include "cablenet/partition/local_network.hpp"

namespace cablenet::system {

/// The program's one loop over elements.
/// @param visit  bool(element index, element); false ends the loop
template <class Visit>
bool for_each_element(const partition::LocalNetwork& network, Visit&& visit) {
  const std::size_t count = network.elements.size();
  for (std::size_t i = 0; i < count; ++i)
    if (!visit(i, network.elements[i])) return false;
  return true;
}

}   // namespace cablenet::system
