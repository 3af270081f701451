#include "snes_options.hpp"

#include <algorithm>
#include <array>

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

}   // namespace

bool is_harmless_snes_option(const std::string& option) {
  const auto begins = [&](const char* beginning) { return option.starts_with(beginning); };
  return std::find(harmless_options.begin(), harmless_options.end(), option) != harmless_options.end() ||
         std::any_of(harmless_beginnings.begin(), harmless_beginnings.end(), begins);
}

}   // namespace cablenet::solve
