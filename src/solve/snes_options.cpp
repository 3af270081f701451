#include "snes_options.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "cablenet/petsc/options.hpp"

namespace cablenet::solve {
namespace {

constexpr std::array harmless_options{"atol",
                                      "rtol",
                                      "stol",
                                      "max_it",
                                      "max_funcs",
                                      "max_fail",
                                      "divergence_tolerance",
                                      "error_if_not_converged",
                                      "type",
                                      "converged_reason"};
constexpr std::array harmless_beginnings{"monitor", "view", "linesearch"};

constexpr std::array watching_beginnings{"monitor", "view", "converged_reason"};

template <class Beginnings>
bool begins_with_one(const std::string& option, const Beginnings& beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](const char* beginning) { return option.starts_with(beginning); });
}

bool is_harmless(const std::string& option) {
  return std::find(harmless_options.begin(), harmless_options.end(), option) != harmless_options.end() ||
         begins_with_one(option, harmless_beginnings);
}

/// Whether all given options of SNES satisfy `is_allowed`, which is told a name without its beginning "snes_".
template <class Allowed>
bool all_given(const std::string& prefix, Allowed is_allowed) {
  const std::string beginning = prefix + "snes_", nested = prefix + "npc_";
  const std::vector<std::string> given = petsc::given_options();
  return std::all_of(given.begin(), given.end(), [&](const std::string& name) {
    if (name.starts_with(nested)) return false;
    return !name.starts_with(beginning) || is_allowed(name.substr(beginning.size()));
  });
}

}   // namespace

bool given_snes_options_are_harmless(const std::string& prefix) { return all_given(prefix, is_harmless); }

bool given_snes_options_only_watch(const std::string& prefix) {
  return all_given(prefix, [](const std::string& name) { return begins_with_one(name, watching_beginnings); });
}

}   // namespace cablenet::solve
