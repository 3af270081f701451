#include <mpi.h>

#include <cstdlib>
#include <exception>
#include <iostream>

#include "cablenet/app/run.hpp"

namespace {

/// An exception that nobody catches may have been thrown on one rank alone.  Unwinding there would leave the others
/// waiting.
[[noreturn]] void abort_all_ranks() {
  int rank = 0, started = 0;
  MPI_Initialized(&started);
  if (started) MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  try {
    if (const auto error = std::current_exception()) std::rethrow_exception(error);
    std::cerr << "[rank " << rank << "] cablenet: stopped without a reason" << std::endl;
  } catch (const std::exception& error) {
    std::cerr << "[rank " << rank << "] cablenet: " << error.what() << std::endl;
  } catch (...) {
    std::cerr << "[rank " << rank << "] cablenet: unknown exception" << std::endl;
  }
  if (started) MPI_Abort(MPI_COMM_WORLD, 3);
  std::_Exit(3);
}

}   // namespace

int main(int argc, char** argv) {
  // Open MPI opens a semaphore of the machine for each file, by the file's name.  A run that was killed leaves it
  // behind, and the next run would wait for it without end.
  setenv("OMPI_MCA_sharedfp", "^sm", 0);
  std::set_terminate(abort_all_ranks);
  return cablenet::app::run(argv[0], {argv + 1, argv + argc});
}
