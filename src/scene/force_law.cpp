#include "cablenet/scene/force_law.hpp"

#include <algorithm>

namespace cablenet::scene {

ForceLaw ForceLaw::rows(const std::vector<double>& times, const std::vector<Vector3>& forces) {
  double largest = 0;
  for (const Vector3& force : forces) largest = std::max(largest, force.norm());
  const auto law = [times, forces](double t) -> Vector3 {
    const auto after = std::upper_bound(times.begin(), times.end(), t);
    if (after == times.begin()) return forces.front();
    if (after == times.end()) return forces.back();
    const auto i = static_cast<std::size_t>(after - times.begin());
    const double share = (t - times[i - 1]) / (times[i] - times[i - 1]);
    return (1 - share) * forces[i - 1] + share * forces[i];
  };
  return {law, largest};
}

}   // namespace cablenet::scene
