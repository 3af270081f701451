#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "cablenet/base/linear_algebra.hpp"

/// Prescribed motions of points: positions as twice differentiable functions of time.
/// Tests: tests/unit/motion_test.cpp
namespace cablenet::scene {

/// Position, velocity and acceleration at one time, world frame.
struct Kinematics {
  Vector3 x;   ///< [m]
  Vector3 v;   ///< [m/s]
  Vector3 a;   ///< [m/s^2]
};

/// A law of motion; immutable, cheap to copy (shared), safe to evaluate at any time in [first_time, last_time].
class Motion {
public:
  /// x = p
  static Motion fixed(const Vector3& position);
  /// x = p + v (t - t0)
  static Motion uniform(const Vector3& position, const Vector3& velocity, double t0);
  /// x = p + A sin(2 pi t / period + phase)
  /// @param period [s], > 0   @param phase [rad]
  static Motion harmonic(const Vector3& position, const Vector3& amplitude, double period, double phase);
  /// Natural cubic spline through (times[i], positions[i]): C2, zero acceleration at the two ends.
  /// @pre times strictly increasing, at least two of them.
  static Motion waypoints(const std::vector<double>& times, const std::vector<Vector3>& positions);
  /// x = p + (ex(t), ey(t), ez(t)); differentiated symbolically.
  /// @throws InputError if a text is no expression of t, naming the text and what is allowed.
  /// Limits: belongs, with its shifted copies, to one thread.
  static Motion expression(const Vector3& position, const std::array<std::string, 3>& texts);

  /// The same law at x + offset.
  Motion shifted(const Vector3& offset) const;

  Kinematics at(double t) const;
  double first_time() const;   ///< -infinity unless waypoints
  double last_time() const;    ///< +infinity unless waypoints

  /// A law; implementations live in motion.cpp.
  struct Law;

private:
  explicit Motion(std::shared_ptr<const Law> law) : law_(std::move(law)) {}
  std::shared_ptr<const Law> law_;
};

}   // namespace cablenet::scene
