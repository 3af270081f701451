#pragma once
#include <petscksp.h>
#include <petscsnes.h>

#include <string>
#include <vector>

/// PETSc solver defaults in one place; whatever the user's options say wins.
namespace cablenet::solve {

/// KSP preonly with LU in natural (leaf-to-root) order on one rank.  On more ranks: for trees and near-trees the same
/// LU of the whole network on every rank (exact, and many times cheaper than a distributed factorisation while fill is
/// nil), eliminating in the same order, so that rounding is the same too; for nets MUMPS. Reads the options database.
/// Collective.
/// @param elimination  node numbers in the order of elimination; empty for nets
void configure_linear_solver(KSP ksp, const std::vector<int>& elimination);

/// Newton with a basic line search, an absolute tolerance alone.
/// @param force_tolerance [N]
/// Does not read the options database: TSSetFromOptions does.
void configure_newton(SNES snes, double force_tolerance);

/// "preonly + lu (mumps)": what a configured KSP really is.
std::string describe_linear_solver(KSP ksp);

}   // namespace cablenet::solve
