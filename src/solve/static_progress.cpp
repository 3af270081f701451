#include "cablenet/solve/static_progress.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <limits>

#include "cablenet/solve/own_options.hpp"

namespace cablenet::solve {
namespace {

constexpr double period = 2;   // [s] of wall time
/// PETSc 3.22 refuses an infinite number as the default of an option.
constexpr double unlimited = std::numeric_limits<double>::max();

double seconds(std::chrono::steady_clock::duration d) { return std::chrono::duration<double>(d).count(); }

}   // namespace

StaticProgress::StaticProgress(MPI_Comm communicator)
    : communicator_(communicator),
      monitors_(petsc::flag_option(communicator, nullptr, statics_monitor_option.text)),
      limit_(read_number(statics_time_limit_option, communicator, nullptr, unlimited, 0, unlimited)) {
  MPI_Comm_rank(communicator, &rank_);
}

bool StaticProgress::note(const char* way, double residual, double reference, const std::string& details) {
  const Clock::time_point now = Clock::now();
  if (rank_ == 0 && monitors_)
    fmt::print("  statics {}, {}: residual {:.6g} N, {:.3g} of the loads{}\n", iterations_, way, residual,
               residual / reference, details);
  else if (is_due(now))
    show(now, fmt::format("{}: residual {:.3g} of the loads", way, residual / reference));
  return goes_on(now);
}

bool StaticProgress::note_settling(double t, double duration) {
  const Clock::time_point now = Clock::now();
  if (is_due(now)) show(now, fmt::format("the network settles, {:.3g} of {:.3g} s", t, duration));
  return goes_on(now);
}

bool StaticProgress::is_due(Clock::time_point now) const { return rank_ == 0 && seconds(now - shown_) > period; }

void StaticProgress::show(Clock::time_point now, const std::string& text) {
  shown_ = now;
  fmt::print("statics: {:.0f} s, iteration {}, {}\n", seconds(now - begun_), iterations_, text);
  std::fflush(stdout);
}

/// Clocks differ from rank to rank.  So the first rank alone reads its clock, and all follow it.
bool StaticProgress::goes_on(Clock::time_point now) {
  if (limit_ == unlimited) return true;
  int over = seconds(now - begun_) > limit_ ? 1 : 0;
  MPI_Bcast(&over, 1, MPI_INT, 0, communicator_);
  is_over_ = over != 0;
  return !is_over_;
}

}   // namespace cablenet::solve
