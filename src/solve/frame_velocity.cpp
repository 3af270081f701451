#include "cablenet/solve/frame_velocity.hpp"

#include <algorithm>
#include <cmath>

namespace cablenet::solve {
namespace {

/// By how much a component of the tow points' velocities may vary, over its middle: by `steadiness` in the first part
/// of the window, or else by `agreement` in all of it.  A tow with surge is within the agreement.  A harmonic motion
/// alone is not: it changes more within a tenth of a run that is longer than its period.
constexpr double agreement = 0.25, steadiness = 1e-6, first_part = 0.2;

/// At how many times within the window a motion is looked at.
constexpr int samples = 8;

/// Looks at all prescribed nodes' velocities in a window.  Collective.
/// @returns whether they differ by at most the tolerance times their middle; components that do not are zero in
/// `common`
bool find_common_velocity(const system::Assembler& assembler, double t, double window, double tolerance,
                          Vector3& common) {
  double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300};
  for (const auto& [node, motion] : assembler.network().prescribed)
    for (int i = 0; i <= samples; ++i) {
      const double when = std::min(t + window * i / samples, motion.last_time());
      const Vector3 v = motion.at(when).v;
      for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], v(k)), high[k] = std::max(high[k], v(k));
    }
  MPI_Allreduce(MPI_IN_PLACE, low, 3, MPI_DOUBLE, MPI_MIN, assembler.communicator());
  MPI_Allreduce(MPI_IN_PLACE, high, 3, MPI_DOUBLE, MPI_MAX, assembler.communicator());
  bool agree = true;
  common.setZero();
  for (int k = 0; k < 3; ++k) {
    const double middle = 0.5 * (low[k] + high[k]);
    const bool agrees = high[k] - low[k] <= tolerance * std::abs(middle);
    if (agrees) common(k) = middle;
    agree = agree && agrees;
  }
  return agree;
}

}   // namespace

Vector3 frame_velocity(const system::Assembler& assembler, double t, double window) {
  Vector3 common;
  if (!find_common_velocity(assembler, t, first_part * window, steadiness, common))
    find_common_velocity(assembler, t, window, agreement, common);
  return common;
}

}   // namespace cablenet::solve
