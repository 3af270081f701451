#pragma once
#include <chrono>

namespace cablenet::app {

/// One line that keeps changing on a terminal, a plain line every few seconds elsewhere.  For one rank.
class Progress {
public:
  Progress(double start, double end);

  /// @param t simulated time [s]   @param newton iterations so far
  void step(double t, double dt, long steps, long newton);
  /// Ends the changing line.
  void finish(double t, long steps, long newton);

private:
  using Clock = std::chrono::steady_clock;
  void print(double t, double dt, long steps, long newton);

  double start_, end_;
  bool terminal_;
  bool line_open_ = false;
  Clock::time_point begun_ = Clock::now();
  Clock::time_point shown_ = Clock::now();
};

}   // namespace cablenet::app
