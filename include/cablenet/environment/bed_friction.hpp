#pragma once
#include <algorithm>
#include <cmath>
#include <utility>

#include "cablenet/base/linear_algebra.hpp"

/// Friction of what lies on a flat bed, along the bed.  A law answers with the force on a node that is pressed to the
/// bed by N [N].  Tests: tests/unit/bed_friction_test.cpp
namespace cablenet::environment {

/// A force along the bed and its derivatives by the node's position and velocity and by N.  The derivatives are set
/// where they are asked for.
struct FrictionForce {
  Vector3 force = Vector3::Zero();   ///< [N]
  Matrix3 by_x = Matrix3::Zero();    ///< [N/m]
  Matrix3 by_v = Matrix3::Zero();    ///< [N s/m]
  Vector3 by_N = Vector3::Zero();    ///< [1]
};

inline Vector3 along_bed(const Vector3& vector) { return {vector.x(), vector.y(), 0}; }

/// (1 - d d^T) along the bed, for a unit vector d along it.
inline Matrix3 across(const Vector3& d) { return Vector3(1, 1, 0).asDiagonal().toDenseMatrix() - d * d.transpose(); }

struct NoFriction {
  static constexpr bool acts = false;
};

/// -mu N v_t/sqrt(v_t^2 + v_s^2), with the velocity v_t along the bed.  It holds nothing that is at rest.
struct ViscousFriction {
  static constexpr bool acts = true;
  double mu;
  double v_s;   ///< [m/s], > 0

  template <bool with_tangent>
  FrictionForce at(double N, const Vector3&, const Vector3& v) const {
    FrictionForce result;
    if (N <= 0) return result;
    const Vector3 slip = along_bed(v);
    const double speed = std::sqrt(slip.squaredNorm() + v_s * v_s);
    const Vector3 per_N = -mu / speed * slip;
    result.force = N * per_N;
    if constexpr (with_tangent) {
      result.by_N = per_N;
      result.by_v = -mu * N / speed * (across(Vector3::Zero()) - slip * slip.transpose() / (speed * speed));
    }
    return result;
  }
};

/// The node holds the bed at its grip.  A spring and a damper side by side pull the node back with p = k s + c v_t.
/// Here s is the way along the bed from the grip to the node, and v_t is the node's velocity along the bed.
/// The force is -p where |p| <= mu N.  Elsewhere the node slips, and the force is -mu N p/|p|.  regripped() says how
/// the grip then follows. Source: Wriggers, Computational Contact Mechanics (2006), section 5.2, the return mapping.
struct StickFriction {
  static constexpr bool acts = true;
  double mu;
  double stiffness;   ///< k [N/m], > 0
  double damping;     ///< c [N s/m], >= 0
  Vector3 grip;       ///< its z does not matter [m]
  /// Slopes take the factor mu N/|p| of what slips as constant.  Newton's method then converges slowly, but it does not
  /// alternate between sticking and slipping.
  bool is_cautious = false;
  /// x and y of p at the step's last tangent.  If p has turned round since, Newton's method has jumped past the place
  /// where the node sticks.  The slope along p is then that of the chord between the two forces.  Null: it stays zero.
  double* last = nullptr;

  template <bool with_tangent>
  FrictionForce at(double N, const Vector3& x, const Vector3& v) const {
    FrictionForce result;
    if (N <= 0 || mu == 0) return result;
    const Vector3 p = along_bed(stiffness * (x - grip) + damping * v);
    const double pull = p.norm(), most = mu * N;
    const bool slips = pull > most;
    result.force = slips ? Vector3(-most / pull * p) : Vector3(-p);
    if constexpr (with_tangent) {
      const Vector3 direction = slips ? Vector3(p / pull) : Vector3(Vector3::Zero());
      if (slips) result.by_N = -mu * direction;
      const double share = slips ? most / pull : 1, chord = chord_since_last(most, p);
      const double along = is_cautious ? share : chord;
      const Matrix3 slope = share * across(direction) + along * direction * direction.transpose();
      result.by_x = -stiffness * slope;
      result.by_v = -damping * slope;
    }
    return result;
  }

  /// Where the grip is after the node has come to x: no farther from it than the spring holds.  What is not pressed to
  /// the bed takes its grip along.
  Vector3 regripped(double N, const Vector3& x) const {
    const Vector3 s = along_bed(x - grip);
    const double way = s.norm(), longest = mu * std::max(N, 0.0) / stiffness;
    return way <= longest ? grip : Vector3(x - longest / way * s);
  }

  /// The work that takes the node from the grip to x under a constant N.  Part of it is stored in the spring.  [J]
  double potential(double N, const Vector3& x) const {
    const double way = along_bed(x - grip).norm(), most = mu * std::max(N, 0.0), longest = most / stiffness;
    return way <= longest ? 0.5 * stiffness * way * way : most * (way - 0.5 * longest);
  }

private:
  /// Keeps p as the last.
  double chord_since_last(double most, const Vector3& p) const {
    if (last == nullptr) return 0;
    const Vector3 before(std::exchange(last[0], p.x()), std::exchange(last[1], p.y()), 0);
    return before.dot(p) < 0 ? 2 * most / (before.norm() + p.norm()) : 0;
  }
};

}   // namespace cablenet::environment
