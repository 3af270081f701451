#include "shortest_period.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cablenet::accuracy {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();
/// A motion is looked at so many times.  The number shares no factor with usual numbers of periods.
constexpr int looks = 4999;

double period_of(const scene::Motion& motion, const scene::Time& time) {
  double v = 0, a = 0;
  for (int i = 0; i < looks; ++i) {
    const scene::Kinematics now = motion.at(time.start + (time.end - time.start) * (i + 0.5) / looks);
    v += now.v.squaredNorm();
    a += now.a.squaredNorm();
  }
  return a > 0 ? 2 * std::numbers::pi * std::sqrt(v / a) : endless;
}

}   // namespace

double shortest_period(const scene::Scene& scene) {
  double shortest = endless;
  if (scene.fluid)
    for (const auto& wave : scene.fluid->waves)
      if (wave.amplitude > 0) shortest = std::min(shortest, 2 * std::numbers::pi / wave.frequency);
  for (const auto& point : scene.points)
    if (point.motion) shortest = std::min(shortest, period_of(*point.motion, scene.time));
  return shortest;
}

}   // namespace cablenet::accuracy
