#pragma once
#include <string>
#include <vector>

/// Words for messages about names.  Tests: tests/unit/read_test.cpp
namespace cablenet::scene {

/// " Did you mean X?" if one of `candidates` is at most two letters away, else "".
std::string did_you_mean(const std::string& name, const std::vector<std::string>& candidates);

/// "a, b, c" of the first ten and how many more there are.
std::string listed(const std::vector<std::string>& names);

}   // namespace cablenet::scene
