#pragma once
#include <petscmat.h>

/// Short questions to PETSc's objects.  Not collective.
namespace cablenet::petsc {

/// Whoever made the matrix says that it is symmetric.
bool is_known_symmetric(Mat matrix);

}   // namespace cablenet::petsc
