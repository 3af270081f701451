#include "cablenet/petsc/queries.hpp"

#include "cablenet/petsc/handle.hpp"

namespace cablenet::petsc {

bool is_known_symmetric(Mat matrix) {
  PetscBool known = PETSC_FALSE, flag = PETSC_FALSE;
  check(MatIsSymmetricKnown(matrix, &known, &flag));
  return known == PETSC_TRUE && flag == PETSC_TRUE;
}

}   // namespace cablenet::petsc
