#include "cablenet/network/network.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cablenet/bodies/rigid_body.hpp"

namespace cablenet::network {

std::size_t Network::span_at(int element) const {
  const auto after = std::upper_bound(spans.begin(), spans.end(), element,
                                      [](int e, const Span& span) { return e < span.first_element; });
  return static_cast<std::size_t>(after - spans.begin()) - 1;
}

std::string Network::element_name(int element) const {
  const Span& span = spans[span_at(element)];
  return fmt::format("{}, element {} of {}", span.name, element - span.first_element + 1, span.elements);
}

std::int64_t Network::unknowns() const {
  std::int64_t count = 3 * (position.size() - static_cast<std::int64_t>(prescribed.size() + carried.size()));
  for (const Body& body : bodies) count += bodies::rotation_unknowns(body.properties.rotation);
  return count;
}

double Network::extent() const {
  if (position.empty()) return 0;
  Eigen::AlignedBox3d box;
  for (const Vector3& point : position) box.extend(point);
  return box.diagonal().norm();
}

}   // namespace cablenet::network
