#pragma once
#include <mpi.h>
#include <petscvec.h>

#include "cablenet/base/archive.hpp"
#include "cablenet/partition/local_network.hpp"
#include "cablenet/solve/motion_means.hpp"

namespace cablenet::solve {

/// How well steps have followed a motion.
struct StepFindings {
  long looked_at;     ///< so many steps, one in several; error, step and motion are theirs
  double error;       ///< the mean local error (LocalError) of the steps looked at [m]
  double step;        ///< the mean length of the steps looked at [s]
  double motion;      ///< the largest distance of any node or attachment from where it was at the start [m]
  double shortest;    ///< of all steps [s]
  int order;          ///< p, where the error of a step grows as its length to the power p
  bool is_adaptive;   ///< The steps follow the motion.
  double total;       ///< of the local errors of all steps, each by itself, in root mean squares over the mass [m]
  double path;        ///< how far the mass has gone on its ways, likewise [m]
  double way;         ///< how far the mass was from its start at most, likewise [m]

  /// An order of 2 says that errors add up: that of a step counts over LocalError::memory.
  bool adds_up() const { return order == 2; }
  /// Of a period where errors add up, else of a step, over the motion.
  double share() const;
  /// The step whose share would be this.  [s]
  double step_for(double wanted) const;
  /// A path longer than this many ways is counted as this long.  That is the path of some ten periods, or of fifteen
  /// rounds of a circle.
  static constexpr double counted_ways = 32;
  /// The path, over the way.
  double ways() const { return way > 0 ? path / way : 0; }
  /// What the steps err on that path, over the way, where errors add up.
  double total_share() const;
  /// By how much the mass lags behind after it, over the way, where energy is lost little by little.
  /// @param lost  in the whole run, of what moved
  double lag(double lost) const;
};

/// Looks at one step in 32, and at one in eight of the first 256: short runs are known by as many.  That costs 0.1 % of
/// a step, and 0.3 %.  The first seven are not looked at: a motion that begins suddenly is at fault there, and not its
/// steps.
///
/// A rope that is caught for a step or two would be missed.  So it looks, too, where Newton's method had a long way to
/// go: there the motion is not what the steps before let expect.  These looks are few, so that they cost as little.
/// Tests: tests/cases/notes.py, tests/parallel/resume_test.cpp
class StepSurvey {
public:
  explicit StepSurvey(const partition::LocalNetwork& network) : network_(network), means_(network) {}

  MotionMeans& means() { return means_; }
  /// @param steps  that were done before
  static bool looks_at(long steps) { return (steps < 256 ? steps % 8 : steps % 32) == 7; }
  /// @param correction  the 2-norm, over all ranks, of the first correction of Newton's method [m]
  bool is_event(long steps, double correction) const;
  /// One step in several, which stands for the others.
  void add_sample(double error, double dt, MPI_Comm communicator, bool is_event);
  /// A step that stands for itself.
  void add_event(double dt, MPI_Comm communicator);
  /// A step is taken that leads to x.
  void end_step(long steps, double dt, Vec x);
  /// Collective.
  StepFindings findings(int order, bool is_adaptive, MPI_Comm communicator) const;
  void archive(Archive& archive);

private:
  /// Of the steps that stand for themselves, or for others.
  struct Sum {
    long steps = 0;
    double error = 0, path = 0;   ///< [m]

    void add(const StepMeans& means, double dt);
  };

  const partition::LocalNetwork& network_;
  MotionMeans means_;
  Sum events_, samples_;
  long steps_ = 0, looked_at_ = 0;
  double error_ = 0, step_ = 0;   ///< sums [m], [s]
  double motion_ = 0;             ///< of this rank's nodes [m]
  double shortest_ = 0;           ///< [s]; 0: there was no step
};

}   // namespace cablenet::solve
