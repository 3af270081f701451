#pragma once
#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/elements/static_rule.hpp"

/// The papers' massless element between a cable's end and a body's centre of gravity.  It is a straight bar, pinned at
/// both ends, that also carries compression.  d is the chord from node 1 to node 2 [m], l its length, e = d/l:
///   T = k (l - L),  f = T e,  internal forces -f on node 1 and +f on node 2                             [N]
/// Where a chord has no length a force is not finite.
/// Source: Tonin & Braun, CILAMCE 2020, eqs 19, 20.  Tests: tests/unit/bar_test.cpp
namespace cablenet::elements {

struct Bar {
  double stiffness;   ///< k = EA/L [N/m], > 0
  double length;      ///< L, unstretched [m], > 0
};

/// A force f [N] and its derivative by the chord [N/m].
struct BarForce {
  Vector3 f;
  Matrix3 K;
};

/// At an instant.
BarForce bar_force(const Bar&, const Vector3& d);
/// Of a step from d0 to d1, with its derivative by d1: f = k (1/2 - L/(l0 + l1)) (d0 + d1).  Then f . (d1 - d0) is the
/// change of energy, and f points along the mean chord, so that angular momentum stays.
BarForce bar_step_force(const Bar&, const Vector3& d0, const Vector3& d1);
/// The force by statics' rule: the tension of a string, or the bar's own force.  The derivative of the bar's own force
/// is not exact.  Its turning part has another tension: the one that the last linear solution predicted from `last`.
BarForce bar_static_force(const Bar&, const StaticRule&, const Vector3& last, const Vector3& d);
/// 1/2 k (l - L)^2.  [J]
double bar_energy(const Bar&, const Vector3& d);

}   // namespace cablenet::elements
