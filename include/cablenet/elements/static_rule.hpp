#pragma once
#include <limits>

namespace cablenet::elements {

/// What stands in for the internal force on the way to equilibrium.
struct StaticRule {
  enum class Kind {
    strings,   ///< The tension is string_tension (l/L)^exponent.  Its energy is convex.  At exponent 1 the force is
               ///< linear, so that the drawn shape does not matter, and water's loads are held in the tangent.  At
               ///< large exponents the strings hardly stretch.
    ropes,     ///< The forces are the cables' own.  The tangent's turning part takes the tension that the last
               ///< linear solution predicted, or the strings' tension where string_tension is given; in any case at
               ///< least least_tension.
    descent,   ///< As ropes, but no axial stiffness is larger than most_stiffness, or than the element was softened to.
               ///< The tangent also has strings of the tension `holding` along all elements.  A slack element has no
               ///< turning part.
    exact      ///< The forces and the tangent are the cables' own.
  } kind = Kind::exact;
  double exponent = 1;
  double string_tension = 0;                                         ///< [N]
  double least_tension = 0;                                          ///< [N]
  double most_stiffness = std::numeric_limits<double>::infinity();   ///< EA [N]
  double holding = 0;                                                ///< [N]
  bool never_pushes = false;                                         ///< All cables are tension_only.

  /// Where ratio is not 0, each element is softened when the law begins: with the tension T that it has there, its
  /// axial stiffness becomes at most ratio (over_tension |T| + least).
  struct Softening {
    double ratio = 0, over_tension = 0;
    double least = 0;   ///< [N]
  } softening{};
};

}   // namespace cablenet::elements
