#include "cablenet/app/energy_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace cablenet::app {
namespace {

/// What the step's formulas may take of the energy that moves before it is worth a note.
constexpr double most_dissipated = 0.1;

/// What has moved is known by so many instants.
constexpr long least_instants = 10;

bool is_damped(const scene::CableType& type) {
  return type.axial_damping > 0 || type.rayleigh_mass > 0 || type.rayleigh_stiffness > 0;
}

/// Of a part in what moved; nothing moved where that is zero.
double share(double part, double moved) { return moved > 0 ? part / moved : 0; }

std::string taken(const char* name, double part, double moved) {
  return fmt::format("{} {} {:.3g} J ({:.2g} %)", name, part < 0 ? "gave" : "took", std::abs(part),
                     100 * share(std::abs(part), moved));
}

}   // namespace

EnergyReport::EnergyReport(const system::EnergySummary& of_run, const scene::Scene& scene)
    : energy(of_run),
      is_damped(std::any_of(scene.cable_types.begin(), scene.cable_types.end(), app::is_damped)),
      is_wet(scene.fluid.has_value()),
      has_bed(scene.bed.has_value()) {}

std::string describe(const EnergyReport& report) {
  const system::EnergySummary& energy = report.energy;
  const auto& [now, moved] = std::tie(energy.now, energy.moved);
  std::string text = fmt::format("energy: {:.3g} J moved; ", moved);
  if (report.is_damped) text += taken("damping", now.damping, moved) + ", ";
  text += taken("the step's formulas", now.dissipated, moved);
  if (report.is_wet) text += ", " + taken("water", now.water, moved);
  if (report.has_bed) text += ", " + taken("the bed", now.bed, moved);
  if (energy.is_accounted) text += fmt::format("; the balance closes to {:.2g}", share(energy.imbalance, moved));
  return text;
}

double lost_share(const EnergyReport& report) {
  return report.energy.instants < least_instants ? 0 : share(report.energy.now.dissipated, report.energy.moved);
}

std::string note_of_dissipation(const EnergyReport& report) {
  const double taken = lost_share(report);
  if (taken <= most_dissipated) return {};
  return fmt::format(
      "the step's formulas took {:.2g} % of the energy that moved: where that was motion, it is gone; shorter steps "
      "take less, and so does a larger time.spectral_radius",
      100 * taken);
}

std::string describe_gain(const EnergyReport& report) {
  const auto& [gained, moved] = std::tie(report.energy.gained, report.energy.moved);
  return fmt::format("the step's formulas have brought in {:.4g} J from nowhere, {:.2g} % of the {:.4g} J that moved",
                     gained, 100 * share(gained, moved), moved);
}

}   // namespace cablenet::app
