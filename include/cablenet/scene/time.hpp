#pragma once
#include <optional>
#include <vector>

#include "cablenet/scene/choice.hpp"

/// How a scene goes through time, and what it writes.
namespace cablenet::scene {

enum class Scheme { energy_momentum, generalized_alpha, plain };
template <>
inline constexpr std::array<Choice<Scheme>, 3> choices<Scheme>{{{Scheme::energy_momentum, "energy_momentum"},
                                                                {Scheme::generalized_alpha, "generalized_alpha"},
                                                                {Scheme::plain, "plain"}}};

struct Time {
  double start = 0;   ///< [s]
  double end = 0;     ///< [s]
  double step =
      0;   ///< of time; the first one where the step is adaptive; 0: Scene::accuracy asks that it be chosen [s]
  Scheme scheme = Scheme::energy_momentum;
  double spectral_radius = 1;
  double axial_dissipation = 0;           ///< xi of energy_momentum: 0 where the scene asks that nothing be removed
  std::optional<double> tolerance = {};   ///< of an adaptive step: its local error of positions [m]; none: equal steps
};

enum class HistoryKind { point, cable, body };

struct HistoryItem {
  HistoryKind kind;
  int index;   ///< into Scene::points, cables or bodies
};

struct Output {
  double interval = 0;   ///< from one frame to the next [s]; 0: every step is a frame
  std::vector<HistoryItem> history;
  bool energy = false;
  std::vector<HistoryItem> stiffness;   ///< points and bodies whose stiffness in the equilibrium is asked for
};

}   // namespace cablenet::scene
