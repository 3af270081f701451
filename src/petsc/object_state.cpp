#include "cablenet/petsc/object_state.hpp"

// The functions are documented for users, their declarations are not.
#include <petsc/private/petscimpl.h>

#include "cablenet/petsc/handle.hpp"

namespace cablenet::petsc {

VectorState state_of(Vec vector) {
  VectorState state;
  check(PetscObjectGetId(reinterpret_cast<PetscObject>(vector), &state.vector));
  check(PetscObjectStateGet(reinterpret_cast<PetscObject>(vector), &state.values));
  return state;
}

void mark_changed(Mat matrix) { (void)PetscObjectStateIncrease(reinterpret_cast<PetscObject>(matrix)); }

}   // namespace cablenet::petsc
