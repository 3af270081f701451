#pragma once
#include "cablenet/environment/bed_friction.hpp"

/// Friction that has a potential, for statics.  Tests: tests/unit/bed_friction_test.cpp
namespace cablenet::environment {

/// Friction that takes another N than the one at hand.
template <class Law>
struct HeldFriction {
  static constexpr bool acts = true;
  Law law;
  double N;   ///< [N]

  template <bool with_tangent>
  FrictionForce at(double, const Vector3& x, const Vector3& v) const {
    FrictionForce result = law.template at<with_tangent>(N, x, v);
    result.by_N.setZero();
    return result;
  }
};

}   // namespace cablenet::environment
