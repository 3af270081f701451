#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cablenet/scene/force_law.hpp"
#include "cablenet/scene/motion.hpp"
#include "cablenet/scene/time.hpp"
#include "rows.hpp"

/// Vectors that depend on time, as a scene file gives them: by rows or by expressions.  Their form is the same for each
/// quantity, only units differ.  Tests: tests/unit/read_test.cpp, tests/cases/broken/
namespace cablenet::scene {

/// Rows [t, x, y, z] in the order of time.
struct TimedRows {
  std::vector<double> times;      ///< [s], increasing
  std::vector<Vector3> vectors;   ///< one per time
};

/// Three expressions of the time t.
struct WrittenVector {
  std::array<std::string, 3> texts{"0", "0", "0"};
};

/// A list of at least two rows [t, x, y, z].  @param unit  of x, y and z
Kind<TimedRows> timed_rows(const std::string& unit);
/// {x, y, z}.
Kind<WrittenVector> written_vector();

/// A vector that depends on time, as the file gives it: one of the two.
struct LawKeys {
  std::optional<TimedRows> waypoints;
  std::optional<WrittenVector> expression;
  std::optional<Value> law;   ///< the value of the one that is given, for messages
};

/// The vector that goes through the waypoints, or origin + expression.
/// @param what  must be finite, for messages: "position, velocity or acceleration"
/// @throws InputError if the waypoints do not cover the scene's time, or if the expression is not finite at some time
/// of the scene.
Motion make_law(const LawKeys&, const Vector3& origin, const Time&, const std::string& what);

/// A motion as the file gives it, before the point's position is known.  Without any of the four it is `fixed`.
struct MotionKeys : LawKeys {
  struct Harmonic {
    Vector3 amplitude = Vector3::Zero();   ///< [m]
    double period = 0;                     ///< [s]
    double phase = 0;                      ///< [rad]
  };
  std::optional<Vector3> velocity;   ///< [m/s]
  std::optional<Harmonic> harmonic;
};
Kind<MotionKeys> motion();
/// @throws InputError if the motion is not known at all times of the scene.
Motion make_motion(const MotionKeys&, const Vector3& position, const Time&);

/// A force as the file gives it: constant, or a law.
struct ForceKeys : LawKeys {
  Vector3 constant = Vector3::Zero();   ///< [N]
};
Kind<ForceKeys> force();
/// Straight lines between the waypoints, or the expression; nothing for a constant force.
/// @throws InputError if the force is not known at all times of the scene.
std::optional<ForceLaw> make_force_law(const ForceKeys&, const Time&);

}   // namespace cablenet::scene
