#pragma once
#include <string>

namespace cablenet::solve {

/// With options of SNES that are harmless Newton computes its tangents itself.  With any other one SNES computes them
/// as it likes.
/// @param option  without "-" and "snes_"
bool is_harmless_snes_option(const std::string& option);

}   // namespace cablenet::solve
