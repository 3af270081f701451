#pragma once
#include <span>
#include <string>

#include "cablenet/petsc/options.hpp"

/// The program's own options, which it adds to PETSc's.  `cablenet run -help` and `cablenet run --help` show them.
/// Tests: tests/cases/options.py
namespace cablenet::solve {

struct OwnOption {
  petsc::OptionText text;
  const char* expected;   ///< what a value may be: "a number from 0 to 0.5"
  const char* fallback;   ///< what holds where the option is not given
};

extern const OwnOption axial_dissipation_option, tangent_option, elimination_limit_option, statics_monitor_option,
    statics_time_limit_option, most_gained_option;

std::span<const OwnOption* const> own_options();

/// A number from `least` to `most`.  Collective.
/// @param prefix    as in petsc/options.hpp
/// @param fallback  the value where the option is not given
/// @throws InputError for a number outside of that
double read_number(const OwnOption& option, MPI_Comm communicator, const char* prefix, double fallback, double least,
                   double most);

/// Shows all of them where the user asked for -help.  Collective.
void show_own_options(MPI_Comm communicator);

}   // namespace cablenet::solve
