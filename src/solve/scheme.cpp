#include "cablenet/solve/scheme.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace cablenet::solve {
namespace {

constexpr auto other_scheme = "scheme: energy_momentum, or a smaller spectral_radius";

/// Chung and Hulbert's weights, second order for every spectral radius.
AlphaWeights chung_hulbert(double radius) {
  const double alpha_m = (2 - radius) / (1 + radius), alpha_f = 1 / (1 + radius);
  const double root = 0.5 * (1 + alpha_m - alpha_f);
  return {alpha_m, alpha_f, 0.5 + alpha_m - alpha_f, root * root};
}

/// The stage stays at the step's middle, where the force of both ends belongs.  The inertia alone damps.
/// Source: Wood, Bossak & Zienkiewicz, IJNME 15 (1980) 1562, whose alpha is -(alpha_m - 1/2) with the stage at the end.
AlphaWeights centred(double radius) {
  const double delta = (1 - radius) / (1 + radius);
  return {0.5 + delta, 0.5, 0.5 + delta, 0.25 * (1 + delta) * (1 + delta)};
}

constexpr SchemeRow rows[] = {
    {scene::Scheme::energy_momentum, true, centred, "some axial_damping"},
    {scene::Scheme::generalized_alpha, false, chung_hulbert, other_scheme},
    {scene::Scheme::plain, false, chung_hulbert, other_scheme},
};

}   // namespace

const SchemeRow& row_of(scene::Scheme scheme) {
  return *std::find_if(std::begin(rows), std::end(rows), [&](const SchemeRow& row) { return row.scheme == scheme; });
}

AlphaWeights weights_of(const scene::Time& time) { return row_of(time.scheme).weights(time.spectral_radius); }

system::ForceRule force_rule_of(const scene::Time& time) {
  return {time.scheme, row_of(time.scheme).has_axial_dissipation ? time.axial_dissipation : 0,
          elements::Tangent::exact};
}

std::string describe(const scene::Time& time, const system::ForceRule& rule) {
  const SchemeRow& row = row_of(time.scheme);
  std::string text = fmt::format("{}, spectral radius {}", scene::name_of(row.scheme), time.spectral_radius);
  if (row.has_axial_dissipation) text += fmt::format(", axial dissipation {}", rule.axial_dissipation);
  return text;
}

}   // namespace cablenet::solve
