#pragma once
#include <petscmat.h>

/// Short questions to PETSc.  Not collective.
namespace cablenet::petsc {

bool has_option(const char* name);

/// Whoever made the matrix says that it is symmetric.
bool is_known_symmetric(Mat matrix);

}   // namespace cablenet::petsc
