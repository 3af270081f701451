#pragma once
#include <mpi.h>

#include <chrono>
#include <string>

/// How statics comes along.  It counts iterations and shows each of them where the user asks (-cable_statics_monitor),
/// or else a line every two seconds.  It ends what takes longer than the user wants (-cable_statics_time_limit).
/// Tests: tests/verification/static_scenes.py
namespace cablenet::solve {

class StaticProgress {
public:
  /// Collective.  Reads the options database.
  /// @throws InputError if the limit is negative
  explicit StaticProgress(MPI_Comm communicator);

  /// Before each correction.  Collective.
  /// @param way       in a word, how it is gone
  /// @param residual  [N]   @param reference  what it is measured by [N]
  /// @param details   for those who look at each iteration
  /// @returns false where the time is over
  bool note(const char* way, double residual, double reference, const std::string& details);
  /// Likewise where the network settles in time, after each step.
  /// @param t  how far it has come [s]   @param duration  how far it has to come [s]
  bool note_settling(double t, double duration);
  void count() { ++iterations_; }
  int iterations() const { return iterations_; }
  bool is_over() const { return is_over_; }
  double limit() const { return limit_; }   ///< [s]

private:
  using Clock = std::chrono::steady_clock;

  bool is_due(Clock::time_point now) const;
  void show(Clock::time_point now, const std::string& text);
  bool goes_on(Clock::time_point now);

  MPI_Comm communicator_;
  int rank_ = 0;
  bool monitors_;
  double limit_;
  Clock::time_point begun_ = Clock::now(), shown_ = begun_;
  int iterations_ = 0;
  bool is_over_ = false;
};

}   // namespace cablenet::solve
