#include "cablenet/network/hanging.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "cablenet/network/shape.hpp"
#include "cablenet/scene/scene.hpp"

namespace cablenet::network {
namespace {

/// The horizontal distance of the ends over the length below which the two legs are taken to hang side by side, and how
/// far each is then bent sideways, so that no two nodes coincide.
constexpr double upright = 1e-2, bend = 1e-3;

/// Solves sinh(u)/u = ratio > 1 for u > 0.  Newton's method on log(sinh(u)/u) starts above the solution.
double catenary_parameter(double ratio) {
  double u = ratio < 3 ? std::sqrt(6 * (ratio - 1)) : std::log(2 * ratio) + std::log(std::log(2 * ratio));
  for (int i = 0; i < 60; ++i) {
    const double g = u + std::log1p(-std::exp(-2 * u)) - std::log(2 * u) - std::log(ratio);
    const double slope = 1 / std::tanh(u) - 1 / u;
    const double next = std::max(u - g / slope, 0.1 * u);
    if (std::abs(next - u) <= 1e-15 * u) return next;
    u = next;
  }
  return u;
}

/// Solves sin(u)/u = ratio for u in (0, pi].
double arc_parameter(double ratio) {
  double low = 0, high = std::numbers::pi;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (std::sin(middle) > ratio * middle ? low : high) = middle;
  }
  return high;
}

/// sinh(y) - y, to all digits.
double sinh_beyond(double y) {
  if (y > 0.3) return std::sinh(y) - y;
  const double q = y * y;
  return y * q / 6 * (1 + q / 20 * (1 + q / 42 * (1 + q / 72)));
}

double horizontal_span(const Vector3& a, const Vector3& b) { return std::hypot(b.x() - a.x(), b.y() - a.y()); }

Vector3 horizontal_direction(const Vector3& a, const Vector3& b) {
  const double h = horizontal_span(a, b);
  return h > 0 ? Vector3((b.x() - a.x()) / h, (b.y() - a.y()) / h, 0) : Vector3(1, 0, 0);
}

/// A point of a cable whose ends lie (nearly) above one another.  The cable goes down and up again.  One leg is bent
/// towards x and the other towards y.
Vector3 hairpin_point(const Vector3& a, const Vector3& b, double L, double s) {
  const double down = 0.5 * (L - (b.z() - a.z()));
  const bool first_leg = s < down;
  Vector3 p = a + (b - a) * (s / L);
  p.z() = a.z() - (first_leg ? s : 2 * down - s);
  const double along = first_leg ? s / down : (s - down) / (L - down);
  p[first_leg ? 0 : 1] += bend * L * std::sin(std::numbers::pi * along);
  return p;
}

/// Of a cable that touches nothing.
std::vector<Vector3> free_shape(const Vector3& a, const Vector3& b, const std::vector<double>& arcs) {
  const double L = arcs.back();
  const double rise = b.z() - a.z(), h = horizontal_span(a, b);
  std::vector<Vector3> points;
  points.reserve(arcs.size());
  if (h < upright * L) {
    for (const double s : arcs) points.push_back(hairpin_point(a, b, L, s));
    return points;
  }
  const double u = catenary_parameter(std::sqrt(L * L - rise * rise) / h);
  const double A = h / (2 * u);   // horizontal force / weight per length
  const double x0 = h / 2 - A * std::atanh(rise / L);
  const Vector3 along = horizontal_direction(a, b);
  for (const double s : arcs) {
    const double x = x0 + A * std::asinh(s / A - std::sinh(x0 / A));
    points.push_back(a + along * x + Vector3(0, 0, A * (std::cosh((x - x0) / A) - std::cosh(x0 / A))));
  }
  return points;
}

/// What leads from an end to where the cable lies: a catenary that arrives there flat.  A is the horizontal pull over
/// the pull per length.
struct Leg {
  double height;   ///< of the end above what the cable lies on; below: negative [m]
  double beyond;   ///< as in Hanging

  double own(double A) const { return height < 0 ? beyond * A : A; }
  double arc(double A) const { return std::sqrt(std::abs(height) * (std::abs(height) + 2 * own(A))); }
  double run(double A) const {
    return own(A) > 0 ? 2 * own(A) * std::asinh(std::sqrt(0.5 * std::abs(height) / own(A))) : 0;
  }
  /// arc - run, which falls as A rises.
  double excess(double A) const { return own(A) > 0 ? own(A) * sinh_beyond(run(A) / own(A)) : std::abs(height); }
  /// The place at `t` from where the cable lies: how far it is along, and how high.
  std::array<double, 2> at(double t, double A) const {
    const double B = own(A), up = std::copysign(1.0, height);
    if (B == 0) return {0, up * t};
    return {B * std::asinh(t / B), up * t * t / (std::hypot(B, t) + B)};
  }
};

/// A cable of length L, of which a part lies at height 0 between two legs.
class LyingCable {
public:
  LyingCable(double L, double span, const std::array<Leg, 2>& legs) : L_(L), span_(span), legs_(legs) { solve(); }

  /// Otherwise it hangs freely.
  bool lies() const { return lies_; }

  /// Along from the first end, to the side, and up.
  Vector3 at(double s) const {
    const double first = legs_[0].arc(A_), last = legs_[1].arc(A_);
    const double start = legs_[0].run(A_), end = span_ - legs_[1].run(A_);
    if (s < first) {
      const auto [along, up] = legs_[0].at(first - s, A_);
      return {start - along + bend_of(s / first), 0, up};
    }
    if (s > L_ - last) {
      const auto [along, up] = legs_[1].at(s - (L_ - last), A_);
      return {end + along, bend_of((L_ - s) / last), up};
    }
    const double length = L_ - first - last, t = length > 0 ? (s - first) / length : 0;
    if (A_ > 0 || length <= 0) return {start + (end - start) * t, 0, 0};
    const double half = arc_parameter((end - start) / length), radius = 0.5 * length / half;
    const double angle = (2 * t - 1) * half;
    return {0.5 * (start + end) + radius * std::sin(angle), radius * (std::cos(angle) - std::cos(half)), 0};
  }

private:
  double excess(double A) const { return legs_[0].excess(A) + legs_[1].excess(A); }
  double bend_of(double share) const {
    return span_ < upright * L_ ? bend * L_ * std::sin(std::numbers::pi * share) : 0;
  }

  /// The excess of the legs is what the cable has more than the span.
  void solve() {
    const double slack = L_ - span_;
    lies_ = slack >= excess(0);
    if (lies_) return;
    double low = 1e-18 * L_, high = 1e18 * L_;
    if (excess(high) > slack) return;
    for (int i = 0; i < 100; ++i) {
      A_ = std::sqrt(low * high);
      (excess(A_) > slack ? low : high) = A_;
    }
    lies_ = legs_[0].run(A_) + legs_[1].run(A_) <= span_;
  }

  double L_, span_;
  std::array<Leg, 2> legs_;
  double A_ = 0;
  bool lies_ = false;
};

Vector3 mirrored(const Vector3& p) { return {p.x(), p.y(), -p.z()}; }

/// Of a cable that is pulled downwards.
std::vector<Vector3> sinking_shape(const Vector3& a, const Vector3& b, const std::vector<double>& arcs,
                                   const Hanging& hanging) {
  if (!hanging.rest) return free_shape(a, b, arcs);
  const double level = *hanging.rest;
  const std::array<Leg, 2> legs{{{a.z() - level, hanging.beyond}, {b.z() - level, hanging.beyond}}};
  const LyingCable cable(arcs.back(), horizontal_span(a, b), legs);
  const bool crosses = hanging.beyond > 0 && legs[0].height * legs[1].height < 0;
  if (!cable.lies()) return crosses ? straight_shape(a, b, arcs) : free_shape(a, b, arcs);
  const Vector3 along = horizontal_direction(a, b), aside(-along.y(), along.x(), 0);
  std::vector<Vector3> points;
  points.reserve(arcs.size());
  for (const double s : arcs) {
    const Vector3 p = cable.at(s);
    points.emplace_back(a.x() + along.x() * p.x() + aside.x() * p.y(), a.y() + along.y() * p.x() + aside.y() * p.y(),
                        level + p.z());
  }
  points.front() = a;
  points.back() = b;
  return points;
}

}   // namespace

Hanging hanging_of(const scene::Scene& scene, const scene::CableType& type, const Vector3& a, const Vector3& b) {
  const double lift = scene.fluid ? scene.fluid->density * type.area - type.mass_per_length : 0;
  Hanging sinks;
  if (scene.bed) sinks.rest = scene.bed->level;
  if (!(lift > 0) || scene.gravity == 0) return sinks;
  if (!scene.fluid->surface) return {.floats = true};
  const double surface = *scene.fluid->surface;
  if (a.z() > surface && b.z() > surface) return {false, surface, type.mass_per_length / lift};
  return {true, surface, lift / type.mass_per_length};
}

std::vector<Vector3> catenary_shape(const Vector3& a, const Vector3& b, const std::vector<double>& arcs,
                                    const Hanging& hanging) {
  if (arcs.back() <= (b - a).norm() * (1 + 1e-11)) return straight_shape(a, b, arcs);
  if (!hanging.floats) return sinking_shape(a, b, arcs, hanging);
  Hanging below = hanging;
  if (below.rest) below.rest = -*below.rest;
  std::vector<Vector3> points = sinking_shape(mirrored(a), mirrored(b), arcs, below);
  for (Vector3& point : points) point = mirrored(point);
  return points;
}

}   // namespace cablenet::network
