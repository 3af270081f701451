#pragma once
#include "cablenet/bodies/rotation.hpp"

/// The papers describe an attitude by roll, pitch and yaw.  Tests: tests/unit/rigid_body_test.cpp
namespace cablenet::bodies {

/// y = (roll, pitch, yaw) [rad]: R = Rz(yaw) Ry(pitch) Rx(roll).  Singular where cos(pitch) = 0.
/// Source: Tonin & Braun, CILAMCE 2020, eqs 16, 17.
struct EulerRotation {
  static constexpr int unknowns = 3;

  template <class S>
  static Mat3<S> matrix(const Unknowns<S, 3>& y) {
    using std::cos, std::sin;
    const S cr = cos(y(0)), sr = sin(y(0)), cp = cos(y(1)), sp = sin(y(1)), cy = cos(y(2)), sy = sin(y(2));
    Mat3<S> R;
    R << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr, sy * cp, sy * sp * sr + cy * cr,
        sy * sp * cr - cy * sr, -sp, cp * sr, cp * cr;
    return R;
  }
  /// The matrix A of eq 17, with w = A y'.
  template <class S>
  static Mat3<S> rates(const Unknowns<S, 3>& y) {
    using std::cos, std::sin;
    const S cr = cos(y(0)), sr = sin(y(0)), cp = cos(y(1)), sp = sin(y(1));
    Mat3<S> A;
    A << S(1), S(0), -sp, S(0), cr, sr * cp, S(0), -sr, cr * cp;
    return A;
  }
  /// The motion, with w' = A y'' + B and the vector B of eq 17.
  template <class S>
  static Turning<S, 3> turning(const Unknowns<S, 3>& y, const Unknowns<S, 3>& dy, const Unknowns<S, 3>& ddy) {
    using std::cos, std::sin;
    Turning<S, 3> t{matrix(y), rates(y), {}, {}};
    t.w = t.rates * dy;
    const S cr = cos(y(0)), sr = sin(y(0)), cp = cos(y(1)), sp = sin(y(1));
    const S roll = dy(0), pitch = dy(1), yaw = dy(2);
    Vec3<S> B;
    B << -pitch * yaw * cp, -roll * pitch * sr + roll * yaw * cr * cp - yaw * pitch * sr * sp,
        -pitch * roll * cr - yaw * roll * sr * cp - yaw * pitch * cr * sp;
    t.dw = t.rates * ddy + B;
    return t;
  }
};

}   // namespace cablenet::bodies
