#pragma once
#include <cmath>

#include "cablenet/base/linear_algebra.hpp"

/// How a body's attitude R (body axes to world) and its angular velocity w (body axes, [rad/s]) follow from the
/// unknowns y that describe it.  Templates on the number type, so that tangents come by automatic differentiation.
/// Tests: tests/unit/rigid_body_test.cpp
namespace cablenet::bodies {

template <class S>
using Vec3 = Eigen::Matrix<S, 3, 1>;
template <class S>
using Mat3 = Eigen::Matrix<S, 3, 3>;
template <class S, int n>
using Unknowns = Eigen::Matrix<S, n, 1>;

/// What y, y', y'' say: w = rates y'.
template <class S, int n>
struct Turning {
  Mat3<S> R;
  Eigen::Matrix<S, 3, n> rates;
  Vec3<S> w;
  Vec3<S> dw;   ///< its derivative, body axes [rad/s^2]
};

template <class S>
Mat3<S> skew(const Vec3<S>& r) {
  Mat3<S> m;
  m << S(0), -r(2), r(1), r(2), S(0), -r(0), -r(1), r(0), S(0);
  return m;
}

/// R skew(w).
template <class S>
Mat3<S> times_skew(const Mat3<S>& R, const Vec3<S>& w) {
  Mat3<S> m;
  for (int i = 0; i < 3; ++i) {
    m(i, 0) = w(2) * R(i, 1) - w(1) * R(i, 2);
    m(i, 1) = w(0) * R(i, 2) - w(2) * R(i, 0);
    m(i, 2) = w(1) * R(i, 0) - w(0) * R(i, 1);
  }
  return m;
}

/// A v, for a matrix of plain numbers.
template <class S>
Vec3<S> times(const Matrix3& A, const Vec3<S>& v) {
  Vec3<S> result;
  for (int i = 0; i < 3; ++i) result(i) = A(i, 0) * v(0) + A(i, 1) * v(1) + A(i, 2) * v(2);
  return result;
}

/// y = q = (w, x, y, z) of any length but zero: R is that of q/|q|.
struct QuaternionRotation {
  static constexpr int unknowns = 4;

  template <class S>
  static Mat3<S> matrix(const Unknowns<S, 4>& q) {
    const S s = 2.0 / q.squaredNorm();
    const S wx = s * q(0) * q(1), wy = s * q(0) * q(2), wz = s * q(0) * q(3);
    const S xx = s * q(1) * q(1), xy = s * q(1) * q(2), xz = s * q(1) * q(3);
    const S yy = s * q(2) * q(2), yz = s * q(2) * q(3), zz = s * q(3) * q(3);
    Mat3<S> R;
    R << 1.0 - yy - zz, xy - wz, xz + wy, xy + wz, 1.0 - xx - zz, yz - wx, xz - wy, yz + wx, 1.0 - xx - yy;
    return R;
  }
  /// 2/|q|^2 E(q), E q = 0: w = rates q'.
  template <class S>
  static Eigen::Matrix<S, 3, 4> rates(const Unknowns<S, 4>& q) {
    Eigen::Matrix<S, 3, 4> E;
    E << -q(1), q(0), q(3), -q(2), -q(2), -q(3), q(0), q(1), -q(3), q(2), -q(1), q(0);
    const S s = 2.0 / q.squaredNorm();
    return s * E;
  }
  /// R rates: the angular velocity in the world's axes is that by q'.
  template <class S>
  static Eigen::Matrix<S, 3, 4> world_rates(const Unknowns<S, 4>& q) {
    Eigen::Matrix<S, 3, 4> G;
    G << -q(1), q(0), -q(3), q(2), -q(2), q(3), q(0), -q(1), -q(3), -q(2), q(1), q(0);
    const S s = 2.0 / q.squaredNorm();
    return s * G;
  }
  template <class S>
  static Turning<S, 4> turning(const Unknowns<S, 4>& q, const Unknowns<S, 4>& dq, const Unknowns<S, 4>& ddq) {
    Turning<S, 4> t{matrix(q), rates(q), {}, {}};
    t.w = t.rates * dq;
    const S s = 2.0 * q.dot(dq) / q.squaredNorm();
    t.dw = t.rates * ddq - s * t.w;
    return t;
  }
};

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
  /// A of eq 17.
  template <class S>
  static Mat3<S> rates(const Unknowns<S, 3>& y) {
    using std::cos, std::sin;
    const S cr = cos(y(0)), sr = sin(y(0)), cp = cos(y(1)), sp = sin(y(1));
    Mat3<S> A;
    A << S(1), S(0), -sp, S(0), cr, sr * cp, S(0), -sr, cr * cp;
    return A;
  }
  /// w' = A y'' + B, B of eq 17.
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
