#pragma once
#include <string>

namespace cablenet::solve {

/// With options of SNES that are harmless Newton computes its tangents itself.  With any other one SNES computes them
/// as it likes.
/// @param prefix  of all options
bool given_snes_options_are_harmless(const std::string& prefix);

/// Whether the options of SNES that the user gave leave it to the program when and where a solve ends.
/// @param prefix  of all options
bool given_snes_options_only_watch(const std::string& prefix);

}   // namespace cablenet::solve
