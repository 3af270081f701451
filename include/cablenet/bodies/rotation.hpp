#pragma once
#include <cmath>

#include "cablenet/base/linear_algebra.hpp"

/// The attitude R of a body (body axes to world) and its angular velocity w (body axes, [rad/s]) follow from the
/// unknowns y of the attitude.  The functions are templates on the number type, so that automatic differentiation can
/// give tangents.
/// Tests: tests/unit/rigid_body_test.cpp
namespace cablenet::bodies {

template <class S>
using Vec3 = Eigen::Matrix<S, 3, 1>;
template <class S>
using Mat3 = Eigen::Matrix<S, 3, 3>;
template <class S, int n>
using Unknowns = Eigen::Matrix<S, n, 1>;

/// The rotation that belongs to y, y' and y'', with w = rates y'.
template <class S, int n>
struct Turning {
  Mat3<S> R;
  Eigen::Matrix<S, 3, n> rates;
  Vec3<S> w;
  Vec3<S> dw;   ///< time derivative of w, body axes [rad/s^2]
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

/// The product A v, where only v carries derivatives.
template <class S>
Vec3<S> times(const Matrix3& A, const Vec3<S>& v) {
  Vec3<S> result;
  for (int i = 0; i < 3; ++i) result(i) = A(i, 0) * v(0) + A(i, 1) * v(1) + A(i, 2) * v(2);
  return result;
}

/// The unknowns y are a quaternion q = (w, x, y, z) of any length but zero.  R is the rotation of q/|q|.
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
  /// A linear map of q with E(q) q = 0 and E(a) b = -E(b) a.
  template <class S>
  static Eigen::Matrix<S, 3, 4> E(const Unknowns<S, 4>& q) {
    Eigen::Matrix<S, 3, 4> m;
    m << -q(1), q(0), q(3), -q(2), -q(2), -q(3), q(0), q(1), -q(3), q(2), -q(1), q(0);
    return m;
  }
  /// rates = 2/|q|^2 E(q), with w = rates q'.
  template <class S>
  static Eigen::Matrix<S, 3, 4> rates(const Unknowns<S, 4>& q) {
    const S s = 2.0 / q.squaredNorm();
    return s * E(q);
  }
  /// world_rates = R rates, so that world_rates q' is the angular velocity in world axes.
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

}   // namespace cablenet::bodies
