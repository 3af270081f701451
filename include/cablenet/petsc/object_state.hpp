#pragma once
#include <petscmat.h>
#include <petscvec.h>

/// PETSc counts the changes of each of its objects.  Not collective.
namespace cablenet::petsc {

/// Which values the vector has, by number.
PetscObjectState state_of(Vec vector);

/// Tells solvers that the matrix's values are new: for values written into the arrays of its parts.
void mark_changed(Mat matrix);

}   // namespace cablenet::petsc
