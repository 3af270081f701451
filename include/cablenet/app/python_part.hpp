#pragma once
#include <string>
#include <vector>

/// The commands that are written in Python, as src/chart.  They start the program themselves, for each run.
/// Tests: tests/cases/chart.py, tests/cases/install.py
namespace cablenet::app {

/// Becomes Python, which does the command; to be called before MPI starts.  Python is /usr/bin/python3, or what the
/// environment's CABLENET_PYTHON names.
/// @returns only where that is not possible: the reason has been said, and this is the exit status
int become_python_part(const std::string& name, const std::vector<std::string>& words);

}   // namespace cablenet::app
