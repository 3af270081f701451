#pragma once
#include <petscmat.h>
#include <petscvec.h>

/// PETSc counts the changes of each of its objects.  Not collective.
namespace cablenet::petsc {

/// Which vector, and which values it has, by numbers.
struct VectorState {
  PetscObjectId vector = 0;
  PetscObjectState values = -1;
  bool operator==(const VectorState&) const = default;
};

VectorState state_of(Vec vector);

/// Tells solvers that the matrix's values are new: for values written into the arrays of its parts.
void mark_changed(Mat matrix);

}   // namespace cablenet::petsc
