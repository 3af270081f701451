#pragma once
#include <limits>

#include "cablenet/elements/cable_step.hpp"

namespace cablenet::elements {

/// Which tension turns the chord in a tangent.  Newton's method needs fewer corrections with the tension that the last
/// tangent of the solve lets expect at the present chord than with the force's own, which turning has falsified.  The
/// solution is the same.
/// Source: Magisano, Leonetti & Garcea, Comput. Methods Appl. Mech. Engng 313 (2017) 319.
struct Turning {
  bool is_predicted = false;
  const Vector3* last = nullptr;   ///< the chord's direction at the last tangent; null at a solve's first one
  Vector3* now = nullptr;          ///< where the present direction is kept
  double least = -std::numeric_limits<double>::infinity();   ///< that the predicted tension is taken for [N]
};

/// The length that a chord is expected to have.  @param at_first  that of a solve's first tangent [m]
inline double expected_length(const Turning& turning, const Stretch& s, double at_first) {
  return turning.last == nullptr ? at_first : turning.last->dot(s.d);
}

/// Keeps the chord's direction for the next tangent.  A law does so last: the compiler has to expect that what it
/// writes is what the law has read.
inline void keep_direction(const Turning& turning, const Stretch& s) {
  if (turning.is_predicted) *turning.now = direction(s);
}

}   // namespace cablenet::elements
