#pragma once
#include <petscksp.h>
#include <petscsnes.h>

#include <string>

/// PETSc solver defaults in one place; whatever the user's options say wins.
namespace cablenet::solve {

/// KSP preonly with LU: PETSc's own in natural (leaf-to-root) order on one rank, MUMPS on more.
/// Reads the options database.  Collective.
void configure_linear_solver(KSP ksp);

/// Newton with a basic line search, an absolute tolerance alone.
/// @param force_tolerance [N]
/// Does not read the options database: TSSetFromOptions does.
void configure_newton(SNES snes, double force_tolerance);

/// "preonly + lu (mumps)": what a configured KSP really is.
std::string describe_linear_solver(KSP ksp);

}   // namespace cablenet::solve
