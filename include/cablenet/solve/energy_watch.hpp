#pragma once
#include "cablenet/scene/time.hpp"
#include "cablenet/solve/alpha_step.hpp"
#include "cablenet/system/energies.hpp"

/// Ends runs whose energy comes from nowhere.  Tests: tests/parallel/energy_test.cpp, tests/cases/energy_watch.py
namespace cablenet::solve {

/// energy_momentum with its own weights, which conserves energy or damps it, cannot gain any.  Others can: they, or
/// options that took energy_momentum off its weights, have to be watched.
bool may_gain_energy(const scene::Time& time, const AlphaWeights& weights);

/// The scheme's weights take energy.  The axial dissipation is not counted.
bool damps(const AlphaWeights& weights);

/// Whether energies are looked at after so many steps: one in 16, and one in four of the first 64.  That costs less
/// than 1 % of a step.
constexpr bool looks_at_energy(long steps) { return steps % (steps < 64 ? 4 : 16) == 0; }

/// The formulas have brought more energy into the network than a run that is right can show.
/// @param rounding  of stored energies [J]
/// @param most      over what the run moves
bool gains_energy(const system::EnergySummary& energy, double rounding, double most = 0.05);

/// What helps against it, as advice.
const char* cure_of_gain(scene::Scheme scheme);

}   // namespace cablenet::solve
