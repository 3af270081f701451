#pragma once
#include <string>
#include <vector>

namespace cablenet::app {

/// The program: cablenet `words`.
/// @returns the exit status: 0 done, 2 wrong input, 3 the solver could not go on, 4 output could not be written.
int run(const std::string& program, const std::vector<std::string>& words);

}   // namespace cablenet::app
