#pragma once
#include "cablenet/scene/scene.hpp"

/// Which step comes next: steps land on output times, shrink after a failure and grow back.
/// Tests: tests/parallel/schedule_test.cpp
namespace cablenet::solve {

class Schedule {
public:
  /// @param interval between outputs [s]; 0: every step is output
  Schedule(double start, double end, double step, double interval);

  double time() const { return t_; }
  double interval() const { return interval_; }
  /// The next step [s]: the time to the next output, evenly divided into steps no longer than the current limit.
  double next_step() const { return h_; }
  /// A step of `taken` was done (smaller than next_step() after retries).
  /// @param retried the step failed before: keep the smaller step; after four good ones it doubles, until it is back at
  /// `step`.
  void advance(double taken, bool retried);
  /// Steps are chosen elsewhere, and cut to the next output; they no longer grow by themselves.
  void set_limit(double wanted);
  bool at_output() const { return at_output_; }
  bool at_end() const { return t_ >= end_; }

private:
  double goal() const;
  void plan();

  double start_, end_, step_, interval_;
  double t_;
  double limit_;   ///< current longest step
  bool grows_ = true;
  int good_ = 0;       ///< steps since the last retry or growth
  long outputs_ = 0;   ///< passed after the start
  bool at_output_ = true;
  double from_ =
      0;   ///< the plan: `total_` steps of h_ from here; times are from_ + k h_, so rounding does not pile up
  double h_ = 0;
  long done_ = 0;
  long total_ = 1;
};

}   // namespace cablenet::solve
