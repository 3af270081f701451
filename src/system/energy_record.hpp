#pragma once
#include <mpi.h>

#include "cablenet/base/archive.hpp"
#include "cablenet/system/energies.hpp"

namespace cablenet::system {

/// The extremes of a run's energies.  Tests: tests/parallel/energy_test.cpp
class EnergyRecord {
public:
  /// @param is_accounted  as in the summary
  EnergyRecord(MPI_Comm communicator, bool is_accounted) : communicator_(communicator) {
    summary_.is_accounted = is_accounted;
  }

  /// @param part  this rank's, at the start or later   Collective.
  void add(const Energies& part);
  const EnergySummary& summary() const { return summary_; }
  void archive(Archive& archive);

private:
  MPI_Comm communicator_;
  EnergySummary summary_;
  Energies first_;                  ///< at the start, on all ranks
  double highest_dissipated_ = 0;   ///< likewise
};

/// Says what the step's formulas have taken where nothing else takes energy (losses.hpp), by looking at instants.
class EnergyLooks {
public:
  explicit EnergyLooks(MPI_Comm communicator) : record_(communicator, false) {}

  /// @param part  this rank's energies at the start or later, the work of prescribed nodes included   Collective.
  void add(Energies part);
  const EnergySummary& summary() const { return record_.summary(); }
  void archive(Archive& archive);

private:
  EnergyRecord record_;
  bool has_begun_ = false;
  double start_ = 0;   ///< this rank's part [J]
};

}   // namespace cablenet::system
