#include "cablenet/petsc/object_state.hpp"

// The functions are documented for users, their declarations are not.
#include <petsc/private/petscimpl.h>

#include "cablenet/petsc/handle.hpp"

namespace cablenet::petsc {

PetscObjectState state_of(Vec vector) {
  PetscObjectState state = 0;
  check(PetscObjectStateGet(reinterpret_cast<PetscObject>(vector), &state));
  return state;
}

void mark_changed(Mat matrix) { (void)PetscObjectStateIncrease(reinterpret_cast<PetscObject>(matrix)); }

}   // namespace cablenet::petsc
