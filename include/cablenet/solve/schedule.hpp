#pragma once
#include "cablenet/base/archive.hpp"

/// Plans the steps of a run: steps land on the output times, shrink after a failure and grow back.
/// Tests: tests/parallel/schedule_test.cpp
namespace cablenet::solve {

class Schedule {
public:
  /// @param step      the longest step that is asked for [s]
  /// @param interval  between outputs [s]; 0: every step is output
  Schedule(double start, double end, double step, double interval);

  double time() const { return t_; }
  double interval() const { return interval_; }
  /// The next step [s].  The time to the next output is divided into equal steps, none longer than the limit.
  double next_step() const { return h_; }
  /// A step was done.
  /// @param taken    its length [s], less than next_step() if attempts failed before it
  /// @param retried  attempts failed before it.  Steps then stay as short; after every four good ones their limit
  ///                 doubles, until it is back at `step`
  void advance(double taken, bool retried);
  /// No step is to be longer than `wanted` [s].  From now on the limit changes by this function alone.
  void set_limit(double wanted);
  bool at_output() const { return at_output_; }
  bool at_end() const { return t_ >= end_; }
  void archive(Archive& archive);

private:
  double goal() const;
  void plan();

  double start_, end_, step_, interval_;
  double t_;
  double limit_;   ///< of a step's length, for the time being [s]
  bool grows_ = true;
  int good_ = 0;       ///< steps since the last retry or growth
  long outputs_ = 0;   ///< passed after the start
  bool at_output_ = true;
  /// The plan: `total_` steps of h_ from the time from_, of which `done_` are done.  Times are from_ + k h_, so that
  /// rounding does not pile up.
  double from_ = 0;
  double h_ = 0;
  long done_ = 0;
  long total_ = 1;
};

}   // namespace cablenet::solve
