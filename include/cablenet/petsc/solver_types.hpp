#pragma once

namespace cablenet::petsc {

/// Looks at -snes_type, -snes_linesearch_type, -ksp_type, -pc_type and -mat_type before anything is solved.
/// Not collective.
/// @param prefix  of the options, nullptr for none
/// @throws InputError on every rank alike if this PETSc has no such type, naming those that it has.
void check_solver_types(const char* prefix);

}   // namespace cablenet::petsc
