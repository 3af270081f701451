#pragma once

namespace cablenet {

/// How a node's position, velocity and acceleration follow the unknown that a tangent is by: 1, dv/dx [1/s],
/// da/dx [1/s^2]; (0, 0, 1) for a mass matrix.
struct Shift {
  double x = 1;
  double v = 0;
  double a = 0;
};

}   // namespace cablenet
