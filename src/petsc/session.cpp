#include "cablenet/petsc/session.hpp"

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

Session::~Session() { PetscFinalize(); }

}   // namespace cablenet::petsc
