#pragma once
#include <mpi.h>

#include <array>

#include "cablenet/base/archive.hpp"
#include "cablenet/partition/local_network.hpp"

namespace cablenet::solve {

/// How one step moves all masses: root mean squares over the mass.
struct StepMeans {
  double error;   ///< the local error of this step by itself [m]
  double way;     ///< the distance from the start, at its largest so far [m]
  double speed;   ///< [m/s]
};

/// How one mass moves in a step.
struct MassMotion {
  double mass;    ///< [kg]
  double error;   ///< the local error of this step by itself [m]
  double scale;   ///< on which it errs: that of a vibration is its amplitude, that of a circle its radius [m]
  double way;     ///< from its start [m]
  double speed;   ///< [m/s]
};

/// The means over the masses of nodes and bodies.  A node has the halves of its elements' masses.
class MotionMeans {
public:
  explicit MotionMeans(const partition::LocalNetwork& network);

  double mass(LocalNode node) const { return mass_[node]; }
  double way() const { return way_; }
  void begin() { sums_ = {}; }
  /// Of which the means are.
  void add_mass(LocalNode node) { sums_[0] += mass_[node]; }
  /// A vibration's error ends at its amplitude, so that the errors of small ones do not add up.
  void add(const MassMotion& motion);
  /// Of what was added since begin().  Collective.
  StepMeans end(MPI_Comm communicator);
  void archive(Archive& archive) { archive.item("motion_means.way", way_); }

private:
  Table<LocalNode, double> mass_;   ///< of owned nodes [kg]
  std::array<double, 4> sums_{};    ///< of m, m error^2, m way^2 and m speed^2, m the masses
  double way_ = 0;                  ///< as StepMeans::way
};

}   // namespace cablenet::solve
