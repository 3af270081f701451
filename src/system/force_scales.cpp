#include "cablenet/system/force_scales.hpp"

#include <cmath>
#include <limits>

namespace cablenet::system {

ForceScales ForceScales::of(const ForceSums& here, MPI_Comm communicator) {
  double sums[] = {here.load, here.stiffness, here.mass, here.bed};
  MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_DOUBLE, MPI_SUM, communicator);
  return {std::sqrt(sums[0]), std::sqrt(sums[1]), std::sqrt(sums[2]), std::sqrt(sums[3])};
}

double ForceScales::rounding(double furthest, double shift_a) const {
  return std::numeric_limits<double>::epsilon() * (furthest * (stiffness + shift_a * mass) + bed);
}

}   // namespace cablenet::system
