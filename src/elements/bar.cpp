#include "cablenet/elements/bar.hpp"

#include <algorithm>
#include <cmath>

namespace cablenet::elements {
namespace {

/// axial e e^T + turning (I - e e^T)
Matrix3 slope(double axial, double turning, const Vector3& e) {
  Matrix3 K = (axial - turning) * e * e.transpose();
  K.diagonal().array() += turning;
  return K;
}

}   // namespace

BarForce bar_force(const Bar& bar, const Vector3& d) {
  const double l = d.norm(), T = bar.stiffness * (l - bar.length);
  const Vector3 e = 1 / l * d;
  return {T * e, slope(bar.stiffness, T / l, e)};
}

BarForce bar_step_force(const Bar& bar, const Vector3& d0, const Vector3& d1) {
  const double l1 = d1.norm(), both = d0.norm() + l1;
  const Vector3 mean = 1 / both * (d0 + d1);
  const double T = 0.5 * bar.stiffness * (both - 2 * bar.length);
  Matrix3 K = bar.stiffness * (bar.length / (both * l1)) * mean * d1.transpose();
  K.diagonal().array() += T / both;
  return {T * mean, K};
}

BarForce bar_static_force(const Bar& bar, const StaticRule& rule, const Vector3& last, const Vector3& d) {
  if (rule.kind == StaticRule::Kind::exact) return bar_force(bar, d);
  const double l = d.norm();
  const Vector3 e = 1 / l * d;
  const double string = rule.string_tension * std::pow(l / bar.length, rule.exponent);
  if (rule.kind == StaticRule::Kind::strings) return {string * e, slope(rule.exponent * string / l, string / l, e)};
  // Without what turning has stretched.
  const double corrected = bar.stiffness * (last.dot(d) / last.norm() - bar.length);
  const double expected = rule.string_tension > 0 ? string : corrected;
  return {bar.stiffness * (l - bar.length) * e, slope(bar.stiffness, std::max(expected, rule.least_tension) / l, e)};
}

double bar_energy(const Bar& bar, const Vector3& d) {
  const double stretch = d.norm() - bar.length;
  return 0.5 * bar.stiffness * stretch * stretch;
}

}   // namespace cablenet::elements
