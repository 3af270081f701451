#pragma once
#include <limits>

namespace cablenet::system {

/// What a run keeps of the tension in an element, as it is at the ends of steps.  Tests:
/// tests/parallel/tensions_test.cpp
struct ElementTension {
  double last = std::numeric_limits<double>::infinity();   ///< at the last instant [N]
  double largest = 0, largest_at = 0;                      ///< [N], first at this time [s]
  double lasting = 0;                                      ///< the largest that two instants in a row reached [N]
  double least = 0, least_at = 0;                          ///< the hardest push, negative [N], first at this time [s]
  double pushed = 0;                                       ///< for so long [s]
  /// The integral of sqrt(12 P/m)/L over the running push P, with the mass per length m, and the largest of any push.
  /// Nodes of a chain of elements that push, turned out to this side and that by turns, go further out by exp() of it:
  /// each is driven by 4 P/L and has the inertia m L/3.
  double folding = 0, most_folding = 0;

  /// The largest tension that was not there at one instant alone.  The last instant has no next one to judge it.
  double held() const { return last > lasting && last < std::numeric_limits<double>::infinity() ? last : lasting; }
};

}   // namespace cablenet::system
