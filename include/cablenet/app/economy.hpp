#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cablenet/network/network.hpp"
#include "cablenet/output/shape_record.hpp"
#include "cablenet/solve/dynamics.hpp"

/// What a run says at its end that its scene could do without.  Tests: tests/cases/economy.py
namespace cablenet::app {

struct Economy {
  std::vector<std::string> sentences;   ///< one for each kind
  /// Cables with many more or many fewer elements than 1 % needs, and so many they need.
  std::vector<std::pair<std::string, int>> elements;
};

/// @param steps  of a run through time, where notes were taken
/// @param lost   as step_notes() takes it
Economy economy_of(const scene::Scene& scene, const network::Network& network, const output::ShapeSummary& shapes,
                   const std::optional<solve::StepFindings>& steps, double lost);

}   // namespace cablenet::app
