#include "cablenet/environment/water.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cablenet::environment {
namespace {

/// A wave's motion decays with depth by the factors horizontal = cosh(k (z' + depth))/sinh(k depth) and
/// vertical = sinh(k (z' + depth))/sinh(k depth).  by_z is k, or 0 where the factors do not vary with z.
struct Decay {
  double horizontal, vertical, by_z;
};

/// At a depth of this many 1/k a wave's motion is e^-40 = 4e-18 of its motion at the surface: less than rounding.
constexpr double negligible = 40;

Decay decay(double k, double depth, double z) {
  const double below = std::clamp(z, -depth, 0.0), fall = std::exp(k * below), by_z = z == below && z < 0 ? k : 0;
  const double twice = 2 * k * (below + depth);
  if (twice > negligible) return {fall, fall, by_z};
  // In shallow water sinh as a difference of exponentials would lose digits; expm1 keeps them.
  const double scale = -fall / std::expm1(-2 * k * depth), difference = -std::expm1(-twice);
  return {scale * (2 - difference), scale * difference, by_z};
}

double angle(const Wave& wave, const Vector3& x, double t) {
  return wave.number * wave.direction.dot(x.head<2>()) - wave.frequency * t + wave.phase;
}

/// Adds a vector, decay.horizontal c along the wave and decay.vertical s upwards, and its derivative by the place.  The
/// wave's angle theta moves it along an orbit: dc/dtheta = -s and ds/dtheta = c.
void add_orbit(const Wave& wave, const Decay& decay, double c, double s, Vector3& value, Matrix3& slope) {
  const Eigen::Vector2d along = decay.horizontal * wave.direction, by_x = wave.number * wave.direction;
  value.head<2>() += c * along;
  value.z() += decay.vertical * s;
  slope.topLeftCorner<2, 2>() -= along * (s * by_x).transpose();
  slope.bottomLeftCorner<1, 2>() += decay.vertical * c * by_x.transpose();
  slope.topRightCorner<2, 1>() += decay.by_z * decay.vertical * c * wave.direction;
  slope(2, 2) += decay.by_z * decay.horizontal * s;
}

void add_current(const std::vector<CurrentLayer>& current, double z, WaterMotion& motion) {
  const auto above = std::upper_bound(current.begin(), current.end(), z,
                                      [](double height, const CurrentLayer& layer) { return height < layer.z; });
  if (above == current.begin()) {
    motion.velocity = above->velocity;
    return;
  }
  const CurrentLayer& below = *(above - 1);
  motion.velocity = below.velocity;
  if (above == current.end()) return;
  motion.velocity_slope.col(2) = (above->velocity - below.velocity) / (above->z - below.z);
  motion.velocity += (z - below.z) * motion.velocity_slope.col(2);
}

double smooth_step(double s) { return s * s * (3 - 2 * s); }

/// The mean of the smooth step over s - h/2 .. s + h/2, with by_depth the derivative by s and by_extent the one by h.
/// @pre s <= 1/2.  Differences of nearly equal numbers then occur for long pieces alone, and the division by h makes
///      their rounding harmless.
Wetness dry_half(double s, double h) {
  const double low = s - 0.5 * h, high = s + 0.5 * h;
  if (high <= 0) return {0, 0, 0};
  if (low >= 0)
    return {smooth_step(s) + 0.25 * (1 - 2 * s) * h * h, 6 * s * (1 - s) - 0.5 * h * h, 0.5 * (1 - 2 * s) * h};
  const bool across = high > 1;
  const double top = across ? 1 : smooth_step(high);
  const double mean = (across ? high - 0.5 : high * high * high * (1 - 0.5 * high)) / h;
  return {mean, top / h, (0.5 * top - mean) / h};
}

}   // namespace

double wave_number(double frequency, double depth, double gravity) {
  const double y = frequency * frequency * depth / gravity;
  // Newton's method starts within 5 % everywhere: Eckart, Surface Waves on Water of Variable Depth (1951).
  double x = y / std::sqrt(std::tanh(y));
  for (int i = 0; i < 20; ++i) {
    const double tanh = std::tanh(x), step = (x * tanh - y) / (tanh + x * (1 - tanh * tanh));
    x -= step;
    if (std::abs(step) < 1e-15 * x) break;
  }
  return x / depth;
}

WaterMotion water_motion(const Fluid& fluid, const Vector3& x, double t) {
  WaterMotion motion;
  if (!fluid.current.empty()) add_current(fluid.current, x.z(), motion);
  for (const Wave& wave : fluid.waves) {
    const double z = x.z() - *fluid.surface, k = wave.number;
    if (k * std::min(-z, fluid.depth) > negligible) continue;
    const Decay at = decay(k, fluid.depth, z);
    const double theta = angle(wave, x, t), omega = wave.frequency;
    const double c = wave.amplitude * omega * std::cos(theta), s = wave.amplitude * omega * std::sin(theta);
    add_orbit(wave, at, c, s, motion.velocity, motion.velocity_slope);
    add_orbit(wave, at, omega * s, -omega * c, motion.acceleration, motion.acceleration_slope);
  }
  return motion;
}

std::vector<std::size_t> faint_waves(const Fluid& fluid, double z, double share) {
  using Measures = Eigen::Array3d;   // velocity, acceleration, elevation
  if (fluid.waves.empty()) return {};
  const bool is_at_surface = z >= *fluid.surface - fluid.reach();
  std::vector<Measures> all;
  Measures sum = Measures::Zero();
  for (const Wave& wave : fluid.waves) {
    const double speed =
        wave.amplitude * wave.frequency * decay(wave.number, fluid.depth, z - *fluid.surface).horizontal;
    all.emplace_back(speed, speed * wave.frequency, is_at_surface ? wave.amplitude : 0);
    sum += all.back();
  }
  for (Measures& measures : all) measures = (sum > 0).select(measures / sum, 0);
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return all[a].maxCoeff() < all[b].maxCoeff(); });
  Measures left_out = Measures::Zero();
  std::vector<std::size_t> faint;
  for (const std::size_t i : order) {
    left_out += all[i];
    if (left_out.maxCoeff() > share) break;
    faint.push_back(i);
  }
  std::sort(faint.begin(), faint.end());
  return faint;
}

SurfaceHeight surface_height(const Fluid& fluid, const Vector3& x, double t) {
  SurfaceHeight height{*fluid.surface, Vector3::Zero()};
  for (const Wave& wave : fluid.waves) {
    const double theta = angle(wave, x, t);
    height.z += wave.amplitude * std::cos(theta);
    height.slope.head<2>() -= wave.amplitude * wave.number * std::sin(theta) * wave.direction;
  }
  return height;
}

Wetness piece_wetness(double q, double h, double d) {
  Wetness wet = dry_half(0.5 - std::abs(q) / d, h / d);
  // The wet part of a piece below the surface is as large as the dry part of one as far above it.
  if (q > 0) wet = {1 - wet.fraction, wet.by_depth, -wet.by_extent};
  return {wet.fraction, wet.by_depth / d, wet.by_extent / d};
}

Wetness sphere_wetness(double q, double r) {
  if (std::abs(q) >= r) return {q > 0 ? 1.0 : 0.0, 0, 0};
  const double s = 0.5 + 0.5 * q / r;
  return {smooth_step(s), 3 * s * (1 - s) / r, 0};
}

}   // namespace cablenet::environment
