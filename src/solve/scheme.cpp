#include "cablenet/solve/scheme.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace cablenet::solve {
namespace {

constexpr auto other_scheme = "scheme: energy_momentum, or a smaller spectral_radius";

constexpr SchemeRow rows[] = {
    {scene::Scheme::energy_momentum, false, true, "some axial_damping"},
    {scene::Scheme::generalized_alpha, true, false, other_scheme},
    {scene::Scheme::plain, true, false, other_scheme},
};

/// Takes the place of a scheme that has no spectral radius.
constexpr scene::Scheme scheme_with_radius = scene::Scheme::generalized_alpha;

}   // namespace

const SchemeRow& row_of(scene::Scheme scheme) {
  return *std::find_if(std::begin(rows), std::end(rows), [&](const SchemeRow& row) { return row.scheme == scheme; });
}

void set_spectral_radius(scene::Time& time, double radius) {
  if (!row_of(time.scheme).has_radius) time.scheme = scheme_with_radius;
  time.spectral_radius = radius;
}

AlphaWeights weights_of(const scene::Time& time) {
  const double radius = row_of(time.scheme).has_radius ? time.spectral_radius : 1;
  const double alpha_m = (2 - radius) / (1 + radius), alpha_f = 1 / (1 + radius);
  const double root = 0.5 * (1 + alpha_m - alpha_f);
  return {alpha_m, alpha_f, 0.5 + alpha_m - alpha_f, root * root};
}

system::ForceRule force_rule_of(const scene::Time& time) {
  return {time.scheme, row_of(time.scheme).has_axial_dissipation ? time.axial_dissipation : 0,
          elements::Tangent::exact};
}

std::string describe(const scene::Time& time, const system::ForceRule& rule) {
  const SchemeRow& row = row_of(time.scheme);
  if (row.has_radius) return fmt::format("{}, spectral radius {}", scene::name_of(row.scheme), time.spectral_radius);
  return fmt::format("{}, axial dissipation {}", scene::name_of(row.scheme), rule.axial_dissipation);
}

}   // namespace cablenet::solve
