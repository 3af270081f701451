#pragma once
#include <stdexcept>

/// What can go wrong, by who must act.  main turns each into its exit status.
namespace cablenet {

/// The scene or the command line is wrong; thrown on every rank alike.  Exit status 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The solver could not go on; thrown on every rank alike.  Exit status 3.
struct SolverError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A result could not be written; may be thrown on one rank alone.  Exit status 4.
struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}   // namespace cablenet
