#pragma once

namespace cablenet {

/// A tangent is the derivative of forces by an unknown.  A shift holds the derivatives of a node's position, velocity
/// and acceleration by that unknown: 1, dv/dx [1/s] and da/dx [1/s^2] in an implicit step.  (0, 0, 1) gives a mass
/// matrix.
struct Shift {
  double x = 1;
  double v = 0;
  double a = 0;
};

}   // namespace cablenet
