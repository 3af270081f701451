#include "cablenet/petsc/session.hpp"

#include <fmt/format.h>
#include <petscsys.h>

#include <cstdlib>

#include "cablenet/petsc/handle.hpp"

namespace cablenet::petsc {

Session::Session(const std::string& program, const std::vector<std::string>& options) {
  // hwloc asks any X server on the machine for its graphics cards and dies with it.
  setenv("HWLOC_COMPONENTS", "-gl", 0);
  // PETSc keeps the pointers until PetscFinalize.
  static std::vector<std::string> words;
  static std::vector<char*> pointers;
  words = {program};
  words.insert(words.end(), options.begin(), options.end());
  for (auto& word : words) pointers.push_back(word.data());
  int count = static_cast<int>(pointers.size());
  pointers.push_back(nullptr);
  char** arguments = pointers.data();
  check(PetscInitialize(&count, &arguments, nullptr, nullptr));
}

Session::~Session() {
  // The program reports unused options in its own words.
  PetscOptionsClearValue(nullptr, "-options_left");
  PetscOptionsSetValue(nullptr, "-options_left", "no");
  PetscFinalize();
}

std::vector<std::string> unused_options() {
  PetscInt count = 0;
  char** names = nullptr;
  char** values = nullptr;
  check(PetscOptionsLeftGet(nullptr, &count, &names, &values));
  std::vector<std::string> unused;
  for (PetscInt i = 0; i < count; ++i) {
    const std::string value = values[i] == nullptr ? "" : values[i];
    unused.push_back(fmt::format("-{}{}{}", names[i], value.empty() ? "" : " ", value));
  }
  check(PetscOptionsLeftRestore(nullptr, &count, &names, &values));
  return unused;
}

}   // namespace cablenet::petsc
