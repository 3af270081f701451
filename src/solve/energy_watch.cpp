#include "cablenet/solve/energy_watch.hpp"

#include <algorithm>
#include <cmath>

#include "cablenet/solve/scheme.hpp"

namespace cablenet::solve {
namespace {

/// Over one rounding of all stored energies: what many of them come to.
constexpr double most_roundings = 100;

/// Between weights that are equal but for the options' decimals.
constexpr double same = 1e-9;

bool is_same(const AlphaWeights& one, const AlphaWeights& other) {
  return std::abs(one.alpha_m - other.alpha_m) < same && std::abs(one.alpha_f - other.alpha_f) < same &&
         std::abs(one.gamma - other.gamma) < same && std::abs(one.beta - other.beta) < same;
}

}   // namespace

bool may_gain_energy(const scene::Time& time, const AlphaWeights& weights) {
  return time.scheme != scene::Scheme::energy_momentum || !is_same(weights, weights_of(time));
}

bool damps(const AlphaWeights& weights) { return weights.gamma > 0.5 + same; }

/// Energies that are no numbers are a gain, too.
bool gains_energy(const system::EnergySummary& energy, double rounding, double most) {
  return !(energy.gained <= std::max(most * energy.moved, most_roundings * rounding));
}

const char* cure_of_gain(scene::Scheme scheme) {
  if (scheme == scene::Scheme::energy_momentum)
    return "Leave the -ts_alpha options away, with which energy_momentum does not conserve energy, or try a smaller "
           "time.step";
  return "Write scheme: energy_momentum, which cannot gain energy, or leave time.scheme out, or try a smaller "
         "time.step";
}

}   // namespace cablenet::solve
