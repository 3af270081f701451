#pragma once
#include <array>
#include <cmath>

#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/environment/water.hpp"

/// The wetted part of an element that the surface may cross.  Each half of the element has a wetted fraction, which is
/// that of a straight piece below the height of the water at its middle.  What is integrated over the wetted part takes
/// this fraction as the same everywhere on the half.
/// Tests: tests/unit/cable_in_water_test.cpp
namespace cablenet::elements {

/// The wetted fraction of half an element.
struct WetHalf {
  double fraction;
  std::array<Vector3, 2> by{Vector3::Zero(), Vector3::Zero()};   ///< by the places of the element's two nodes [1/m]
};

/// The integral of N_i over one half of an element of length 1.  N_i is the shape function of node i.
constexpr double half_integral(std::size_t half, std::size_t i) { return i == half ? 3.0 / 8 : 1.0 / 8; }
/// The integral of N_i N_j over one half of an element of length 1.
constexpr double half_integral(std::size_t half, std::size_t i, std::size_t j) {
  return i != j ? 1.0 / 12 : i == half ? 7.0 / 24 : 1.0 / 24;
}

/// Integrals over the wetted part of an element of length 1.
struct WetPart {
  std::array<double, 2> n{0.5, 0.5};                                                  ///< of the shape functions
  std::array<std::array<double, 2>, 2> m{{{1.0 / 3, 1.0 / 6}, {1.0 / 6, 1.0 / 3}}};   ///< of their products

  double length() const { return n[0] + n[1]; }
  /// The place of the wetted part's middle, 0 at node 1 and 1 at node 2.  @pre length() > 0
  double middle() const { return n[1] / length(); }
  /// The integral of the squared distance from the middle: 1/12 where all is wet.
  double spread() const { return m[1][1] - n[1] * middle(); }
};

inline WetHalf wet_half(const environment::Fluid& fluid, double t, double diameter, const std::array<Vector3, 2>& x,
                        std::size_t half) {
  const double at = half == 0 ? 0.25 : 0.75, dz = x[1].z() - x[0].z(), extent = 0.5 * std::abs(dz);
  const Vector3 middle = (1 - at) * x[0] + at * x[1];
  const double still = *fluid.surface - middle.z();
  if (std::abs(still) >= fluid.reach() + 0.5 * (extent + diameter)) return {still > 0 ? 1.0 : 0.0};
  const environment::SurfaceHeight surface = environment::surface_height(fluid, middle, t);
  const environment::Wetness wet = environment::piece_wetness(surface.z - middle.z(), extent, diameter);
  const Vector3 by_middle = wet.by_depth * (surface.slope - Vector3::UnitZ());
  const Vector3 by_rise = (dz < 0 ? -0.5 : 0.5) * wet.by_extent * Vector3::UnitZ();
  return {wet.fraction, {(1 - at) * by_middle - by_rise, at * by_middle + by_rise}};
}

inline WetPart wet_part(const std::array<WetHalf, 2>& halves) {
  WetPart wet;
  for (std::size_t i = 0; i < 2; ++i) {
    wet.n[i] = halves[0].fraction * half_integral(0, i) + halves[1].fraction * half_integral(1, i);
    for (std::size_t j = 0; j < 2; ++j)
      wet.m[i][j] = halves[0].fraction * half_integral(0, i, j) + halves[1].fraction * half_integral(1, i, j);
  }
  return wet;
}

}   // namespace cablenet::elements
