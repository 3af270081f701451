#include "cablenet/petsc/handle.hpp"

#include <fmt/format.h>

namespace cablenet::petsc {

void fail(int code, const char* file, int line) {
  const char* text = nullptr;
  PetscErrorMessage(static_cast<PetscErrorCode>(code), &text, nullptr);
  throw Failure(fmt::format("PETSc error {} ({}) at {}:{}", code, text == nullptr ? "unknown" : text, file, line));
}

}   // namespace cablenet::petsc
