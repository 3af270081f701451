#pragma once
#include <string>
#include <vector>

/// Words for messages about names that are not known.  Tests: tests/unit/read_test.cpp
namespace cablenet::scene {

/// " Did you mean X?", where X is the candidate that needs the fewest changed letters.  Empty if all need more than
/// two.
std::string did_you_mean(const std::string& name, const std::vector<std::string>& candidates);

/// The first ten names, as "a, b, c", and how many more there are.
std::string listed(const std::vector<std::string>& names);

}   // namespace cablenet::scene
