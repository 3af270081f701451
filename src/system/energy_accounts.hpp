#pragma once
#include <array>
#include <memory>
#include <vector>

#include "cable_term.hpp"
#include "cablenet/system/assembler.hpp"
#include "energy_record.hpp"
#include "evaluation.hpp"

namespace cablenet::system {

/// The work of a group of terms in a step, at this rank's nodes.
struct StepWork {
  double path = 0;      ///< residuals at the stage times the nodes' ways x1 - x0 [J]
  double turning = 0;   ///< the share of `path` that is the turning of bodies [J]
  double power = 0;     ///< residuals times velocities, both at the stage [W]
};

/// What the accounts are told of an accepted step.
struct StepRecord {
  const Stage& stage;
  StepWork stored;     ///< of the terms that store energy, and of the cables' damping
  StepWork undamped;   ///< of the same terms, with cables that have no damping
  StepWork water, bed;
  double prescribed_work;    ///< since the start [J]
  double prescribed_shift;   ///< as PrescribedNodes::step_shift()
};

/// Where energy goes, step by step.  A term's work in a step is its residual at the stage times x1 - x0, summed over
/// nodes.  These works add up to that of the prescribed nodes, as the step's equations say.  So the balance closes if
/// each term's work goes to an account:
///   water, bed   the work of the water's terms, of the bed's term
///   damping      the work of the cables, less that of the same cables without damping
///   dissipated   what is left of all work when the three above and the change of stored energy are taken from it
///
/// Where the stage is not the middle of the step, water, bed and damping are powers.  The powers at this stage and at
/// the last one give that at the step's middle.  What this differs from the work goes to `dissipated`, and likewise
/// what prescribed nodes differ by.  So all accounts are of second order, and the balance still closes.
///
/// A body that turns: the work that the other terms do on its turning is known, and so is its kinetic energy.  The
/// difference goes to `dissipated`.
///
/// All numbers are this rank's part, except those of the summary.  Tests: tests/parallel/energy_test.cpp
class EnergyAccounts {
public:
  /// @param scratch, resting  vectors of the solver; `resting` is zero
  EnergyAccounts(const partition::LocalNetwork& network, MPI_Comm communicator, Vector scratch, Vector resting);

  /// The next step's start is known.
  bool is_open() const { return is_open_; }
  /// @param stored  energies, and the terms' work   Collective.
  void open(const LocalState& start, const Energies& stored, double prescribed_work);
  void begin_step(Evaluation& evaluation);
  void end_step(const StepEnd& end);
  /// Measures the nodes' ways to the step's end.
  void measure(const LocalState& end);
  /// The work of the forces in `data`.
  StepWork work(const NodeData& data) const;
  /// Collective.
  void close(const StepRecord& step, const LocalState& end, const Energies& stored);

  /// nullptr where no cable is damped.
  CableTerm* undamped() { return undamped_ ? &undamped_->term : nullptr; }
  Vec scratch() const { return scratch_; }
  Vec resting() const { return resting_; }
  void add_to(Energies& sum) const;
  const EnergySummary& summary() const { return record_.summary(); }
  void archive(Archive& archive);

private:
  struct Undamped {
    explicit Undamped(const partition::LocalNetwork& damped);
    partition::LocalNetwork network;
    CableTerm term;
  };

  double at_middle(std::size_t account, const Stage& stage, const StepWork& work);
  double taken_from_turning(double dt, const LocalState& end) const;
  void summarise(const Energies& stored, double prescribed_work);
  void keep_start(const LocalState& state, const Energies& stored);

  const partition::LocalNetwork& network_;
  Vector scratch_, resting_;
  std::unique_ptr<Undamped> undamped_;
  bool is_open_ = false, has_begun_ = false;
  Energies stored_;                  ///< at the step's start
  std::vector<double> way_;          ///< of the local nodes: where they were at the step's start, then x1 - x0 [m]
  std::vector<Vector3> spins_;       ///< of the bodies at the step's start [rad/s]
  Energies taken_;                   ///< only its dissipated, damping, water, bed and start are used
  std::array<double, 3> power_{};    ///< of damping, water and bed at the last stage [W]
  double previous_stage_time_ = 0;   ///< [s]
  EnergyRecord record_;
  long steps_ = 0;
};

}   // namespace cablenet::system
