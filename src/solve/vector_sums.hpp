#pragma once
#include <petscvec.h>

#include "cablenet/petsc/handle.hpp"

/// Sums over vectors.  Collective.
namespace cablenet::solve {

/// The 2-norm.
inline double norm(Vec v) {
  PetscReal value = 0;
  petsc::check(VecNorm(v, NORM_2, &value));
  return value;
}

inline double dot(Vec a, Vec b) {
  PetscScalar value = 0;
  petsc::check(VecDot(a, b, &value));
  return value;
}

}   // namespace cablenet::solve
