#include "cablenet/petsc/solver_types.hpp"

#include <fmt/format.h>
#include <petscsnes.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "cablenet/base/errors.hpp"
#include "cablenet/petsc/handle.hpp"

namespace cablenet::petsc {
namespace {

std::vector<std::string> names_of(PetscFunctionList list) {
  const char** names = nullptr;
  int count = 0;
  check(PetscFunctionListGet(list, &names, &count));
  std::vector<std::string> result;
  // PETSc before 3.20 counts the null at the end, too.
  for (int i = 0; i < count; ++i)
    if (names[i] != nullptr) result.emplace_back(names[i]);
  check(PetscFree(names));
  std::sort(result.begin(), result.end());
  return result;
}

void check_type(const char* prefix, const char* option, const std::vector<std::string>& allowed) {
  std::array<char, 128> value{};
  PetscBool given = PETSC_FALSE;
  check(PetscOptionsGetString(nullptr, prefix, option, value.data(), value.size(), &given));
  if (given == PETSC_FALSE || std::find(allowed.begin(), allowed.end(), value.data()) != allowed.end()) return;
  throw InputError(fmt::format("-{}{}: `{}` is not allowed; expected one of: {}", prefix == nullptr ? "" : prefix,
                               option + 1, value.data(), fmt::join(allowed, ", ")));
}

}   // namespace

void check_solver_types(const char* prefix) {
  check(SNESInitializePackage());
  check(KSPInitializePackage());
  check(PCInitializePackage());
  check(MatInitializePackage());
  check_type(prefix, "-snes_type", names_of(SNESList));
  check_type(prefix, "-snes_linesearch_type", names_of(SNESLineSearchList));
  check_type(prefix, "-ksp_type", names_of(KSPList));
  check_type(prefix, "-pc_type", names_of(PCList));
  std::vector<std::string> matrices = names_of(MatList);
  // Each of these stands for one type on one rank and another on more.
  for (const char* root : {MATAIJ, MATBAIJ, MATSBAIJ, MATDENSE, MATAIJPERM, MATAIJSELL, MATAIJCRL, MATSELL})
    matrices.emplace_back(root);
  check_type(prefix, "-mat_type", matrices);
}

}   // namespace cablenet::petsc
