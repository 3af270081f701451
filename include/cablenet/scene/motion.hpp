#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "cablenet/base/linear_algebra.hpp"

/// Prescribed motions of points.  A motion gives a position at each time, which can be differentiated twice.
/// Tests: tests/unit/motion_test.cpp
namespace cablenet::scene {

/// Position, velocity and acceleration at one time in the world's axes.
struct Kinematics {
  Vector3 x;   ///< [m]
  Vector3 v;   ///< [m/s]
  Vector3 a;   ///< [m/s^2]
};

/// A law of motion, valid from first_time to last_time.  It never changes, and copies share it.
class Motion {
public:
  /// x = p
  static Motion fixed(const Vector3& position);
  /// x = p + v (t - t0)
  static Motion uniform(const Vector3& position, const Vector3& velocity, double t0);
  /// x = p + A sin(2 pi t / period + phase)
  /// @param period [s], > 0   @param phase [rad]
  static Motion harmonic(const Vector3& position, const Vector3& amplitude, double period, double phase);
  /// The natural cubic spline through (times[i], positions[i]).  It has continuous accelerations, which are zero at
  /// the two ends.
  /// @pre times strictly increasing, at least two of them.
  static Motion waypoints(const std::vector<double>& times, const std::vector<Vector3>& positions);
  /// x = p + (ex(t), ey(t), ez(t)), where e are the texts.  Velocity and acceleration are their symbolic derivatives.
  /// @throws InputError if a text is no twice differentiable expression of t, and says why.
  /// Limits: only one thread may use the motion and its shifted copies.
  static Motion expression(const Vector3& position, const std::array<std::string, 3>& texts);

  /// The same law at x + offset.
  Motion shifted(const Vector3& offset) const;

  Kinematics at(double t) const;
  double first_time() const;   ///< -infinity unless waypoints
  double last_time() const;    ///< +infinity unless waypoints

  /// What each law must be able to do; the laws are in motion.cpp.
  struct Law;

private:
  explicit Motion(std::shared_ptr<const Law> law) : law_(std::move(law)) {}
  std::shared_ptr<const Law> law_;
};

}   // namespace cablenet::scene
