#pragma once
#include <vector>

#include "cablenet/accuracy/history_table.hpp"

namespace cablenet::accuracy {

/// What came of a run.
struct Trial {
  bool is_done = false;
  bool has_start = true;   ///< An equilibrium to start from was found, or none was wanted.
  HistoryTable history = {};
  double work = 0;   ///< iterations of Newton's method, for comparing runs of the same mesh
};

/// Runs that differ in one size alone, from coarse to fine.  With the order p, what the finer of two runs errs by is
///
///     |u_n - u_n-1| / (r^p - 1),   r = h_n-1 / h_n                       (Richardson)
///
/// p is observed where there are three, between 1 and 2, and taken as 2 where there are two.
/// Tests: tests/parallel/accuracy_test.cpp
class Ladder {
public:
  /// @param size  h, smaller than that of the last run
  void add(double size, Trial trial);
  void clear() { rungs_.clear(); }
  std::size_t count() const { return rungs_.size(); }
  double finest() const { return rungs_.back().size; }
  const Trial& finest_trial() const { return rungs_.back().trial; }
  /// The estimated error of the finest run, per column of the history.  Empty where there are not two runs.
  const std::vector<double>& errors() const { return errors_; }
  /// The largest of them.
  double error() const;
  /// The last run changed more than 0.6 of what the run before had changed.
  bool is_stuck() const;
  /// The finest history, less what it errs by to the order 2.  @pre two runs
  HistoryTable limit() const;

private:
  struct Rung {
    double size;
    Trial trial;
  };
  void estimate();

  std::vector<Rung> rungs_;
  std::vector<double> errors_;
  double difference_ = 0, before_ = 0;   ///< the largest one that the last run made, and the run before
};

}   // namespace cablenet::accuracy
