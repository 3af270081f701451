#include "cablenet/solve/motion_means.hpp"

#include <algorithm>
#include <cmath>

namespace cablenet::solve {
namespace {

/// Smaller motion than this part of the way adds no errors up.
constexpr double least_scale = 0.025;

}   // namespace

MotionMeans::MotionMeans(const partition::LocalNetwork& network) : mass_(network.owned, 0.0) {
  for (const auto& load : network.loads)
    if (network.is_owned(load.node)) mass_[load.node] += load.mass;
  for (const partition::LocalElement& element : network.elements)
    for (const LocalNode end : element.node)
      if (const LocalNode node = network.anchor(end); network.is_owned(node))
        mass_[node] += network.materials[at(element.material)].mass_per_length * element.length / 2;
}

void MotionMeans::add(const MassMotion& motion) {
  const double m = motion.mass;
  if (motion.scale >= least_scale * way_) sums_[1] += m * motion.error * motion.error;
  sums_[2] += m * motion.way * motion.way;
  sums_[3] += m * motion.speed * motion.speed;
}

StepMeans MotionMeans::end(MPI_Comm communicator) {
  MPI_Allreduce(MPI_IN_PLACE, sums_.data(), static_cast<int>(sums_.size()), MPI_DOUBLE, MPI_SUM, communicator);
  const auto mean = [this](std::size_t i) { return sums_[0] > 0 ? std::sqrt(sums_[i] / sums_[0]) : 0; };
  way_ = std::max(way_, mean(2));
  return {mean(1), way_, mean(3)};
}

}   // namespace cablenet::solve
