#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "cablenet/base/linear_algebra.hpp"

/// The water as data; how it moves is in water.hpp.
namespace cablenet::environment {

struct CurrentLayer {
  double z;           ///< [m]
  Vector3 velocity;   ///< [m/s]
};

struct Wave {
  double amplitude;            ///< a, half the height [m]
  double frequency;            ///< omega [rad/s]
  double number;               ///< k [1/m]
  Eigen::Vector2d direction;   ///< unit, towards which it runs
  double phase;                ///< [rad]
};

struct Fluid {
  double density = 0;                  ///< [kg/m^3], > 0
  std::optional<double> surface;       ///< z of the still surface [m]; none: water everywhere
  std::vector<CurrentLayer> current;   ///< ascending z, linear between, constant beyond; empty: still water
  std::vector<Wave> waves;             ///< need surface and depth
  double depth = 0;                    ///< below the surface [m]; > 0 where there are waves

  /// The current depends on the height, or there are waves.
  bool varies() const { return current.size() > 1 || !waves.empty(); }
  /// The free surface stays this close to the still one.  [m]
  double reach() const {
    double sum = 0;
    for (const Wave& wave : waves) sum += wave.amplitude;
    return sum;
  }
};

}   // namespace cablenet::environment
