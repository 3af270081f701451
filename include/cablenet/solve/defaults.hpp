#pragma once
#include <petscksp.h>
#include <petscsnes.h>

#include <memory>
#include <string>

#include "cablenet/solve/network_pc.hpp"

/// PETSc solver defaults in one place; whatever the user's options say wins.
namespace cablenet::solve {

/// What solves the linear systems, and why.
struct LinearSolver {
  std::unique_ptr<NetworkPc> elimination;   ///< where the KSP uses it
  bool factors_are_dear = false;            ///< many times a solve: a net's
  std::string reason;                       ///< "12.4 block products a node"
};

/// KSP preonly with the network elimination, or, where its symbolic pass predicts more than -cable_elimination_limit
/// block products a node (nets), MUMPS with METIS.  Reads the options database.  Collective.
/// @param matrix  AIJ unless the user chose another type, which gets PETSc's LU
/// @throws InputError if the limit is negative
LinearSolver configure_linear_solver(KSP ksp, const partition::LocalNetwork& network, Mat matrix);

/// Newton with a basic line search, an absolute tolerance alone.
/// @param force_tolerance [N]
/// Does not read the options database: TSSetFromOptions does.
void configure_newton(SNES snes, double force_tolerance);

/// "preonly + lu (mumps), reason": what a configured KSP really is.
std::string describe(KSP ksp, const LinearSolver& solver);

}   // namespace cablenet::solve
