#pragma once
#include <stdexcept>

/// The exceptions divide failures by who must act on them.  main turns each into an exit status of its own.
namespace cablenet {

/// The scene or the command line is wrong.  All ranks throw it alike.  Exit status 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The solver could not go on.  All ranks throw it alike.  Exit status 3.
struct SolverError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A result could not be written.  One rank alone may throw it.  Exit status 4.
struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}   // namespace cablenet
