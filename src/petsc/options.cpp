#include "cablenet/petsc/options.hpp"

#include <fmt/format.h>
#include <petscviewer.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

#include "cablenet/petsc/handle.hpp"

namespace cablenet::petsc {
namespace {

#if PETSC_VERSION_LT(3, 22, 0)
constexpr auto push_viewers_off = PetscOptionsPushGetViewerOff;
constexpr auto pop_viewers_off = PetscOptionsPopGetViewerOff;
#else
constexpr auto push_viewers_off = PetscOptionsPushCreateViewerOff;
constexpr auto pop_viewers_off = PetscOptionsPopCreateViewerOff;
#endif

/// Parts of the names of options that PETSc looks up while it solves, some of them at set-up as well.
constexpr std::array words_of_viewers{"view", "reason", "compare", "test", "estimate"};

/// PETSc's macros around a block of options need a function that returns an error code.  PETSc's help shows a block of
/// each title once, so that each option needs a block with a title of its own.
template <class Ask>
PetscErrorCode in_block(MPI_Comm communicator, const char* prefix, const OptionText& option, const Ask& ask) {
  PetscFunctionBeginUser;
  const std::string title = fmt::format("Cables' option {}", option.name + 1);
  PetscOptionsBegin(communicator, prefix, title.c_str(), nullptr);
  PetscCall(ask(PetscOptionsObject));
  PetscOptionsEnd();
  PetscFunctionReturn(success);
}

bool may_show(const std::string& name) {
  if (name.starts_with("log_")) return false;
  return std::any_of(words_of_viewers.begin(), words_of_viewers.end(),
                     [&](const char* word) { return name.find(word) != std::string::npos; });
}

}   // namespace

bool has_option(const char* name, const char* prefix) {
  PetscBool found = PETSC_FALSE;
  check(PetscOptionsHasName(nullptr, prefix, name, &found));
  return found == PETSC_TRUE;
}

std::vector<std::string> given_options() {
  char* all = nullptr;
  check(PetscOptionsGetAll(nullptr, &all));
  std::istringstream words(all);
  check(PetscFree(all));
  std::vector<std::string> names;
  for (std::string word; words >> word;)
    if (word.size() > 1 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1])))
      names.push_back(word.substr(1));
  return names;
}

std::vector<std::string> unused_options() {
  // PETSc itself asks for this one when it ends.
  has_option("-options_left");
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

double number_option(MPI_Comm communicator, const char* prefix, const OptionText& option, double fallback) {
  PetscReal value = fallback;
  check(in_block(communicator, prefix, option, [&](auto PetscOptionsObject) {
    return PetscOptionsReal(option.name, option.help, nullptr, value, &value, nullptr);
  }));
  return value;
}

std::string text_option(MPI_Comm communicator, const char* prefix, const OptionText& option,
                        const std::string& fallback) {
  std::array<char, 128> value{};
  check(in_block(communicator, prefix, option, [&](auto PetscOptionsObject) {
    return PetscOptionsString(option.name, option.help, nullptr, fallback.c_str(), value.data(), value.size(), nullptr);
  }));
  return value[0] == '\0' ? fallback : value.data();
}

bool flag_option(MPI_Comm communicator, const char* prefix, const OptionText& option) {
  PetscBool value = PETSC_FALSE;
  check(in_block(communicator, prefix, option, [&](auto PetscOptionsObject) {
    return PetscOptionsBool(option.name, option.help, nullptr, value, &value, nullptr);
  }));
  return value == PETSC_TRUE;
}

bool shows_while_solving() {
  const std::vector<std::string> given = given_options();
  return std::any_of(given.begin(), given.end(), may_show) || !unused_options().empty();
}

ViewersOff::ViewersOff(bool off) : off_(off) {
  if (off_) check(push_viewers_off(PETSC_TRUE));
}

ViewersOff::~ViewersOff() {
  if (off_) (void)pop_viewers_off();
}

}   // namespace cablenet::petsc
