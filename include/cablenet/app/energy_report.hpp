#pragma once
#include <string>

#include "cablenet/scene/scene.hpp"
#include "cablenet/system/energies.hpp"

/// What a run says at its end of where its energy went.  Tests: tests/verification/energy.py
namespace cablenet::app {

struct EnergyReport {
  EnergyReport(const system::EnergySummary& of_run, const scene::Scene& scene);

  system::EnergySummary energy;
  bool is_damped, is_wet, has_bed;   ///< The scene has damping, water, a bed: other accounts are not told.
};

/// "energy: 12.3 J moved; damping took 3.1 J (25 %), ...; the balance closes to 1.2e-12".
std::string describe(const EnergyReport& report);

/// What the step's formulas took, over what moved; 0 where that is known by too few instants.
double lost_share(const EnergyReport& report);
/// "the step's formulas took 57 % of the energy that moved; ...", or nothing where they took little.
std::string note_of_dissipation(const EnergyReport& report);

/// "the step's formulas have brought in 12.3 J from nowhere, 5.4 % of what the run moves".
std::string describe_gain(const EnergyReport& report);

}   // namespace cablenet::app
