#pragma once
#include <mpi.h>

#include <ctime>

#include "cablenet/app/report.hpp"

namespace cablenet::app {

/// Adds the time since construction or the last lap to a phase.
class Stopwatch {
public:
  void lap(Report::Phase& phase) {
    const double wall = MPI_Wtime(), cpu = cpu_seconds();
    phase.wall += wall - wall_;
    phase.cpu += cpu - cpu_;
    wall_ = wall;
    cpu_ = cpu;
  }

private:
  static double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }
  double wall_ = MPI_Wtime();
  double cpu_ = cpu_seconds();
};

}   // namespace cablenet::app
