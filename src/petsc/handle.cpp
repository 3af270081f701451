#include "cablenet/petsc/handle.hpp"

#include <fmt/format.h>

namespace cablenet::petsc {

void check(int code, std::source_location where) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(static_cast<PetscErrorCode>(code), &text, nullptr);
  throw Failure(fmt::format("PETSc error {} ({}) at {}:{}", code, text == nullptr ? "unknown" : text, where.file_name(),
                            where.line()));
}

}   // namespace cablenet::petsc
