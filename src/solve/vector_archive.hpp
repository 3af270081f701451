#pragma once
#include <petscvec.h>

#include "cablenet/base/archive.hpp"
#include "cablenet/petsc/handle.hpp"

namespace cablenet::solve {

/// Saves or loads this rank's values of a vector.
inline void archive_vector(Archive& archive, const char* name, Vec vector) {
  PetscInt size = 0;
  double* values = nullptr;
  petsc::check(VecGetLocalSize(vector, &size));
  petsc::check(VecGetArray(vector, &values));
  archive.item(name, std::span(values, static_cast<std::size_t>(size)));
  petsc::check(VecRestoreArray(vector, &values));
}

}   // namespace cablenet::solve
