#pragma once
#include <mpi.h>

namespace cablenet::system {

/// Sums of squares on one rank.
struct ForceSums {
  double load = 0, stiffness = 0, mass = 0, bed = 0;
};

/// Root-sum-squares over all elements and loads, by which Newton's tolerances are scaled.
struct ForceScales {
  double load = 0;        ///< tension, weight, m v^2/L at the start [N]
  double stiffness = 0;   ///< 2 EA/L [N/m]
  double mass = 0;        ///< [kg]
  double bed = 0;         ///< |level| times the stiffness of contact [N]

  /// Collective.
  static ForceScales of(const ForceSums& sums, MPI_Comm communicator);
  /// The 2-norm of what rounding of positions does to the residual: eps (|x| (stiffness + shift_a mass) + bed).  [N]
  /// @param furthest largest coordinate [m]
  double rounding(double furthest, double shift_a) const;
};

}   // namespace cablenet::system
