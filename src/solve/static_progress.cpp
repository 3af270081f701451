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
      limit_(read_number(statics_time_limit_option, communicator, nullptr, unlimited, 0, unlimited)) {}

/// Clocks differ from rank to rank.  So the first rank alone reads its clock, and all follow it.
bool StaticProgress::note(const char* way, double residual, double reference, const std::string& details) {
  int rank = 0;
  MPI_Comm_rank(communicator_, &rank);
  const Clock::time_point now = Clock::now();
  if (rank == 0 && monitors_)
    fmt::print("  statics {}, {}: residual {:.6g} N, {:.3g} of the loads{}\n", iterations_, way, residual,
               residual / reference, details);
  if (rank == 0 && !monitors_ && seconds(now - shown_) > period) {
    shown_ = now;
    fmt::print("statics: {:.0f} s, iteration {}, {}: residual {:.3g} of the loads\n", seconds(now - begun_),
               iterations_, way, residual / reference);
    std::fflush(stdout);
  }
  if (limit_ == unlimited) return true;
  int over = seconds(now - begun_) > limit_ ? 1 : 0;
  MPI_Bcast(&over, 1, MPI_INT, 0, communicator_);
  is_over_ = over != 0;
  return !is_over_;
}

}   // namespace cablenet::solve
