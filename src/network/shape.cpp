#include "cablenet/network/shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cablenet/base/errors.hpp"
#include "cablenet/scene/motion.hpp"

namespace cablenet::network {
namespace {

/// Taps that are nearer than this part of the cable's length share a node, so that rounding makes no tiny elements.
constexpr double same_arc = 1e-9;

/// Legs that differ by less than this part of their mean are about equally long.
constexpr double equal_legs = 0.05;

/// Chords that differ by less than this part are equal.  A straight line cannot be made longer between its ends: what
/// keeps the equations for that from being singular.
constexpr double equal_lengths = 1e-12, never_singular = 1e-9;
constexpr int most_rounds = 50;

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

/// How many elements lie before an arc length, in parts of all of them.
class Share {
public:
  Share(double L, const std::vector<double>& density) : L_(L), until_{0} {
    for (const double part : density) until_.push_back(until_.back() + part);
    for (double& value : until_) value /= until_.back();
  }

  double before(double arc) const {
    const double parts = static_cast<double>(until_.size() - 1), place = std::clamp(arc / L_, 0.0, 1.0) * parts;
    const std::size_t i = std::min(static_cast<std::size_t>(place), until_.size() - 2);
    return until_[i] + (place - static_cast<double>(i)) * (until_[i + 1] - until_[i]);
  }
  double arc(double share) const {
    const auto next = std::upper_bound(until_.begin() + 1, until_.end() - 1, share);
    const auto i = static_cast<std::size_t>(next - until_.begin()) - 1;
    const double place = static_cast<double>(i) + (share - until_[i]) / (until_[i + 1] - until_[i]);
    return L_ * place / static_cast<double>(until_.size() - 1);
  }

private:
  double L_;
  std::vector<double> until_;   ///< the share before the end of each part
};

template <class Row>
Row row_at(const std::vector<Row>& rows, double fraction) {
  const double place = fraction * static_cast<double>(rows.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), rows.size() - 2);
  return rows[i] + (place - static_cast<double>(i)) * (rows[i + 1] - rows[i]);
}

/// The length until each point.
std::vector<double> drawn_lengths(const std::vector<Vector3>& polyline) {
  std::vector<double> drawn(polyline.size(), 0);
  for (std::size_t i = 1; i < polyline.size(); ++i) drawn[i] = drawn[i - 1] + (polyline[i] - polyline[i - 1]).norm();
  return drawn;
}

std::vector<Vector3> points_by_length(const std::vector<Vector3>& polyline, const std::vector<double>& drawn,
                                      const std::vector<double>& arcs) {
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

/// Solves a symmetric tridiagonal system in place.
void solve_tridiagonal(std::vector<double>& diagonal, const std::vector<double>& beside, std::vector<double>& right) {
  for (std::size_t i = 1; i < diagonal.size(); ++i) {
    const double factor = beside[i - 1] / diagonal[i - 1];
    diagonal[i] -= factor * beside[i - 1];
    right[i] -= factor * right[i - 1];
  }
  for (std::size_t i = diagonal.size(); i-- > 0;) {
    if (i + 1 < diagonal.size()) right[i] -= beside[i] * right[i + 1];
    right[i] /= diagonal[i];
  }
}

/// Moves all points but the ends, each as little as possible, until they are so far apart (Gauss and Newton).
void keep_lengths(std::vector<Vector3>& points, const std::vector<double>& lengths) {
  const std::size_t n = lengths.size();
  double miss = 1;
  for (int round = 0; round < most_rounds && miss > equal_lengths; ++round) {
    std::vector<Vector3> along(n);
    std::vector<double> diagonal(n), beside(n), error(n);
    miss = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Vector3 chord = points[i + 1] - points[i];
      along[i] = chord.normalized();
      error[i] = chord.norm() - lengths[i];
      diagonal[i] = (i > 0) + (i + 1 < n) + never_singular;
      if (i > 0) beside[i - 1] = -along[i - 1].dot(along[i]);
      miss = std::max(miss, std::abs(error[i]) / lengths[i]);
    }
    solve_tridiagonal(diagonal, beside, error);
    for (std::size_t i = 1; i < n; ++i) points[i] += error[i] * along[i] - error[i - 1] * along[i - 1];
  }
}

/// @param drawn  the lengths until each point of a polyline
bool has_equal_legs(const std::vector<double>& drawn) {
  const double mean = drawn.back() / static_cast<double>(drawn.size() - 1);
  for (std::size_t i = 1; i < drawn.size(); ++i)
    if (std::abs(drawn[i] - drawn[i - 1] - mean) > equal_legs * mean) return false;
  return true;
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

/// @param breaks  arc lengths between the stretches
/// @param weights  of the stretches, by which they get elements
std::vector<int> elements_of(const std::vector<double>& breaks, const std::vector<double>& weights, int elements) {
  const std::size_t stretches = breaks.size() - 1;
  if (static_cast<int>(stretches) > elements)
    throw InputError(fmt::format("its taps cut it into {} stretches but it has only {} elements; give it at least {}",
                                 stretches, elements, stretches));
  return share_out(weights, std::accumulate(weights.begin(), weights.end(), 0.0), elements);
}

std::vector<double> graded_arcs(double L, int elements, const std::vector<double>& breaks,
                                const std::vector<double>& density) {
  const Share share(L, density);
  std::vector<double> weights;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    weights.push_back(share.before(breaks[i + 1]) - share.before(breaks[i]));
  const std::vector<int> count = elements_of(breaks, weights, elements);
  std::vector<double> arcs;
  for (std::size_t i = 0; i < count.size(); ++i) {
    arcs.push_back(breaks[i]);
    for (int k = 1; k < count[i]; ++k) arcs.push_back(share.arc(share.before(breaks[i]) + weights[i] * k / count[i]));
  }
  arcs.push_back(L);
  return arcs;
}

}   // namespace

std::vector<double> node_arcs(double L, int elements, std::vector<double> taps, const std::vector<double>& density) {
  const std::vector<double> stretches = stretches_between(L, taps);
  if (!density.empty()) return graded_arcs(L, elements, taps, density);
  const std::vector<int> count = elements_of(taps, stretches, elements);
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

Vector3 row_at(const std::vector<Vector3>& rows, double fraction) { return row_at<Vector3>(rows, fraction); }

std::vector<Vector3> straight_shape(const Vector3& a, const Vector3& b, const std::vector<double>& arcs) {
  std::vector<Vector3> points;
  points.reserve(arcs.size());
  for (const double s : arcs) points.push_back(a + (b - a) * (s / arcs.back()));
  return points;
}

std::vector<Vector3> polyline_shape(const std::vector<Vector3>& polyline, const std::vector<double>& arcs) {
  if (polyline.size() == arcs.size()) return polyline;
  return points_by_length(polyline, drawn_lengths(polyline), arcs);
}

std::vector<Vector3> remeshed_shape(const std::vector<Vector3>& polyline, const std::vector<double>& arcs) {
  const std::vector<double> drawn = drawn_lengths(polyline);
  if (!has_equal_legs(drawn)) return points_by_length(polyline, drawn, arcs);
  std::vector<double> places;
  for (std::size_t i = 0; i < polyline.size(); ++i) places.push_back(static_cast<double>(i));
  const scene::Motion curve = scene::Motion::waypoints(places, polyline);
  std::vector<Vector3> points;
  std::vector<double> until;
  for (const double arc : arcs) {
    points.push_back(curve.at(arc / arcs.back() * places.back()).x);
    until.push_back(row_at(drawn, arc / arcs.back()));
  }
  std::vector<double> lengths;
  for (std::size_t i = 1; i < until.size(); ++i) lengths.push_back(until[i] - until[i - 1]);
  keep_lengths(points, lengths);
  return points;
}

}   // namespace cablenet::network
