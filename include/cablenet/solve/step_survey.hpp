#pragma once
#include <mpi.h>
#include <petscvec.h>

#include "cablenet/base/archive.hpp"
#include "cablenet/partition/local_network.hpp"

namespace cablenet::solve {

/// How well steps have followed a motion.
struct StepFindings {
  long looked_at;    ///< so many steps; the numbers but `shortest` are theirs
  double error;      ///< the mean of their local errors (LocalError) [m]
  double step;       ///< the mean of their lengths [s]
  double motion;     ///< the largest distance of any node from where it was at the start [m]
  double shortest;   ///< of all steps [s]
  int order;         ///< the power of the step's length that the error follows

  /// An order of 2 says that errors add up: that of a step counts over LocalError::memory.
  bool adds_up() const { return order == 2; }
  /// Of a period where errors add up, else of a step, over the motion.
  double share() const;
  /// The step whose share would be this.  [s]
  double step_for(double wanted) const;
};

/// Looks at one step in 32, and at one in eight of the first 256: short runs are known by as many.  That costs 0.1 % of
/// a step, and 0.3 %.  The first seven are not looked at: a motion that begins suddenly is at fault there, and not its
/// steps.
/// Tests: tests/cases/notes.py, tests/parallel/resume_test.cpp
class StepSurvey {
public:
  explicit StepSurvey(const partition::LocalNetwork& network) : network_(network) {}

  /// @param steps  that were done before
  static bool looks_at(long steps) { return (steps < 256 ? steps % 8 : steps % 32) == 7; }
  void add_error(double error) { error_ += error; }
  /// A step is taken that leads to x.
  void end_step(long steps, double dt, Vec x);
  /// Collective.
  StepFindings findings(int order, MPI_Comm communicator) const;
  void archive(Archive& archive);

private:
  const partition::LocalNetwork& network_;
  long looked_at_ = 0;
  double error_ = 0, step_ = 0;   ///< sums [m], [s]
  double motion_ = 0;             ///< of this rank's nodes [m]
  double shortest_ = 0;           ///< [s]; 0: there was no step
};

}   // namespace cablenet::solve
