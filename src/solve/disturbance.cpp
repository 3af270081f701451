#include "disturbance.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include "cablenet/petsc/handle.hpp"

namespace cablenet::solve {
namespace {

/// How far nodes move, over the length of the shortest element there.  Attitudes change as much.
constexpr double disturbance = 0.01;

}   // namespace

void disturb(const partition::LocalNetwork& network, Vec x) {
  std::vector<double> shortest(at(network.nodes), network.extent);
  for (const partition::LocalElement& e : network.elements)
    for (const LocalNode node : e.node) shortest[at(node)] = std::min(shortest[at(node)], e.length);
  double* values = nullptr;
  petsc::check(VecGetArray(x, &values));
  for (LocalNode node(0); network.is_owned(node); ++node) {
    std::minstd_rand random(static_cast<unsigned>(network.scene_node[node].value()) + 1);
    random.discard(10);
    std::uniform_real_distribution<double> uniform(-disturbance, disturbance);
    for (int i = network.begin[node].value(), k = 0; i < network.begin[node + 1].value(); ++i, ++k)
      values[i] += (k < 3 ? shortest[at(node)] : 1) * uniform(random);
  }
  petsc::check(VecRestoreArray(x, &values));
}

}   // namespace cablenet::solve
