#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "cablenet/base/linear_algebra.hpp"

/// The data of the water.  water.hpp computes its motion.
namespace cablenet::environment {

/// One point of a current's profile.
struct CurrentLayer {
  double z;           ///< [m]
  Vector3 velocity;   ///< [m/s]
};

/// One linear wave; water.hpp has its formulas.
struct Wave {
  double amplitude;            ///< a, half the height [m]
  double frequency;            ///< omega [rad/s]
  double number;               ///< k [1/m]
  Eigen::Vector2d direction;   ///< unit vector in which the wave runs
  double phase;                ///< [rad]
};

struct Fluid {
  double density = 0;                  ///< [kg/m^3], > 0
  std::optional<double> surface;       ///< z of the still surface [m]; without one there is water everywhere
  std::vector<CurrentLayer> current;   ///< ascending z, linear between, constant beyond; empty in still water
  std::vector<Wave> waves;             ///< need surface and depth
  double depth = 0;                    ///< of the water below the still surface [m]; > 0 where there are waves

  /// Does the velocity vary with place or time?
  bool varies() const { return current.size() > 1 || !waves.empty(); }
  /// The largest distance between the free surface and the still one.  [m]
  double reach() const {
    double sum = 0;
    for (const Wave& wave : waves) sum += wave.amplitude;
    return sum;
  }
};

}   // namespace cablenet::environment
