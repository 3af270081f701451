#include "equilibrium.hpp"

#include <fmt/format.h>

#include "static_notes.hpp"

namespace cablenet::app {
namespace {

/// A static start moves with the tow points.  For so long their velocity is looked at: this part of the run, or so many
/// seconds where there is no run.
constexpr double steady_part = 0.1, steady_window = 1;

constexpr const char* general_advice =
    "See that every part hangs on something fixed or afloat; try shape: catenary or a drawn shape that is nearer, or "
    "let the scene settle in time with axial_damping";
constexpr const char* slack_advice =
    "There is an equilibrium if no cable pushes: give the cable types tension_only: true";

}   // namespace

std::string name_of(const network::Network& network, const solve::FailedPart& failed) {
  if (failed.body < 0) return fmt::format("cable {}", network.element_name(failed.element));
  return fmt::format("body {}", network.bodies[at(failed.body)].name);
}

Equilibrium::Equilibrium(const scene::Scene& scene, const scene::Time& time, system::Assembler& assembler)
    : scene_(scene), t_(time.start), assembler_(assembler) {
  const double window = time.end > time.start ? steady_part * (time.end - time.start) : steady_window;
  frame_ = solve::StaticForces::frame_velocity(assembler, t_, window);
  statics_.emplace(assembler, t_, frame_);
}

bool Equilibrium::find(const network::Network& network, Report& report) {
  const bool found = statics_->solve();
  report.statics = {frame_, statics_->imbalance(), statics_->largest_load(), statics_->iterations(),
                    statics_->ends_by_rounding()};
  if (found) {
    tell(describe(*report.statics));
    add_notes(network, report);
  } else {
    report.message = fmt::format(
        "no equilibrium was found: {}; the largest unbalanced force is {:.3g} of the largest load on a node, near {}",
        statics_->failure(), statics_->imbalance(), name_of(network, statics_->failed_part()));
  }
  statics_->make_start();
  if (found) report.stiffness = find_stiffness(scene_, network, assembler_, frame_);
  add_note(report, note_of_stiffness(report.stiffness));
  return found;
}

const char* Equilibrium::advice() const { return statics_->is_there_without_pushing() ? slack_advice : general_advice; }

void Equilibrium::add_notes(const network::Network& network, Report& report) {
  if (statics_->is_unstable()) add_note(report, "the equilibrium is not stable: a disturbance would leave it");
  add_note(report, note_of_pushing(network, statics_->pushing(), PETSC_COMM_WORLD));
  add_note(report, note_of_touchdown(network, statics_->on_bed(), PETSC_COMM_WORLD));
}

}   // namespace cablenet::app
