#include "cablenet/network/shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cablenet/base/errors.hpp"

namespace cablenet::network {
namespace {

/// Taps that are nearer than this part of the cable's length share a node, so that rounding makes no tiny elements.
constexpr double same_arc = 1e-9;

std::vector<double> stretches_between(double L, std::vector<double>& breaks) {
  breaks.push_back(0);
  breaks.push_back(L);
  std::sort(breaks.begin(), breaks.end());
  const auto same = [&](double a, double b) { return b - a <= same_arc * L; };
  breaks.erase(std::unique(breaks.begin(), breaks.end(), same), breaks.end());
  breaks.back() = L;
  std::vector<double> stretches(breaks.size() - 1);
  for (std::size_t i = 0; i < stretches.size(); ++i) stretches[i] = breaks[i + 1] - breaks[i];
  return stretches;
}

/// Distributes `elements` over the stretches in proportion to length, at least one each, by largest remainders.
std::vector<int> share_out(const std::vector<double>& stretches, double L, int elements) {
  std::vector<int> count(stretches.size());
  std::vector<double> rest(stretches.size());
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const double quota = stretches[i] / L * elements;
    count[i] = std::max(1, static_cast<int>(std::floor(quota + 1e-6)));
    rest[i] = quota - count[i];
  }
  for (int left = elements - std::accumulate(count.begin(), count.end(), 0); left != 0; left += left > 0 ? -1 : 1) {
    if (left < 0) {
      std::size_t most = 0;
      for (std::size_t i = 0; i < count.size(); ++i)
        if (count[i] > 1 && (count[most] == 1 || rest[i] < rest[most])) most = i;
      --count[most];
      rest[most] += 1;
    } else {
      const auto most = std::max_element(rest.begin(), rest.end()) - rest.begin();
      ++count[static_cast<std::size_t>(most)];
      rest[static_cast<std::size_t>(most)] -= 1;
    }
  }
  return count;
}

}   // namespace

std::vector<double> node_arcs(double L, int elements, std::vector<double> taps) {
  const std::vector<double> stretches = stretches_between(L, taps);
  if (static_cast<int>(stretches.size()) > elements)
    throw InputError(fmt::format("its taps cut it into {} stretches but it has only {} elements; give it at least {}",
                                 stretches.size(), elements, stretches.size()));
  const std::vector<int> count = share_out(stretches, L, elements);
  std::vector<double> arcs;
  arcs.reserve(static_cast<std::size_t>(elements) + 1);
  for (std::size_t i = 0; i < count.size(); ++i)
    for (int k = 0; k < count[i]; ++k) arcs.push_back(taps[i] + stretches[i] * k / count[i]);
  arcs.push_back(L);
  return arcs;
}

int node_at(const std::vector<double>& arcs, double at) {
  const auto next = std::lower_bound(arcs.begin(), arcs.end(), at);
  if (next == arcs.begin()) return 0;
  if (next == arcs.end()) return static_cast<int>(arcs.size()) - 1;
  return static_cast<int>(*next - at < at - *(next - 1) ? next - arcs.begin() : next - 1 - arcs.begin());
}

std::vector<Vector3> straight_shape(const Vector3& a, const Vector3& b, const std::vector<double>& arcs) {
  std::vector<Vector3> points;
  points.reserve(arcs.size());
  for (const double s : arcs) points.push_back(a + (b - a) * (s / arcs.back()));
  return points;
}

std::vector<Vector3> polyline_shape(const std::vector<Vector3>& polyline, const std::vector<double>& arcs) {
  if (polyline.size() == arcs.size()) return polyline;
  std::vector<double> drawn(polyline.size(), 0);
  for (std::size_t i = 1; i < polyline.size(); ++i) drawn[i] = drawn[i - 1] + (polyline[i] - polyline[i - 1]).norm();
  std::vector<Vector3> points;
  points.reserve(arcs.size());
  std::size_t leg = 1;
  for (const double arc : arcs) {
    const double s = arc / arcs.back() * drawn.back();
    while (leg + 1 < drawn.size() && drawn[leg] < s) ++leg;
    const double span = drawn[leg] - drawn[leg - 1];
    const double fraction = span > 0 ? (s - drawn[leg - 1]) / span : 0;
    points.push_back(polyline[leg - 1] + fraction * (polyline[leg] - polyline[leg - 1]));
  }
  return points;
}

}   // namespace cablenet::network
