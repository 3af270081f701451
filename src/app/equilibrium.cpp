#include "equilibrium.hpp"

#include <fmt/format.h>

#include "cablenet/solve/frame_velocity.hpp"
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
constexpr const char* lengths_advice =
    "A tension can be no less than what the weight of the hanging cable makes of it, and it must change with the "
    "cable's length: see that the ends are held, ask for another tension or prestress, or give length or slack";

/// More lengths than these are in run.yaml alone.
constexpr std::size_t most_told = 10;

double unstretched(const network::Network& network, const network::Span& span) {
  double sum = 0;
  for (int i = 0; i < span.elements; ++i) sum += network.elements[at(span.first_element + i)].length;
  return sum;
}

/// The name in `run.yaml`, and what was found: an unstretched length, or a net's slack.
std::pair<std::string, double> found_of(const scene::Scene& scene, const network::Network& network,
                                        const network::Pretension& pretension) {
  const network::Span& span = network.spans[at(pretension.span)];
  if (!pretension.is_net) return {span.name, unstretched(network, span)};
  const network::Element& first = network.elements[at(span.first_element)];
  const scene::Net& net = scene.nets[at(pretension.span) - scene.cables.size()];
  return {span.name, first.length / ((net.corners[1] - net.corners[0]).norm() / net.meshes[0])};
}

}   // namespace

std::string name_of(const network::Network& network, const solve::FailedPart& failed) {
  if (failed.body < 0) return fmt::format("cable {}", network.element_name(failed.element));
  return fmt::format("body {}", network.bodies[at(failed.body)].name);
}

Equilibrium::Equilibrium(const scene::Scene& scene, const scene::Time& time, system::Assembler& assembler)
    : scene_(scene), t_(time.start), assembler_(assembler) {
  const double window = time.end > time.start ? steady_part * (time.end - time.start) : steady_window;
  frame_ = solve::frame_velocity(assembler, t_, window);
  statics_.emplace(assembler, t_, frame_);
}

bool Equilibrium::find_lengths(network::Network& network, Report& report) {
  if (network.pretensions.empty()) return true;
  solve::PretensionSearch search(assembler_, network, t_, frame_);
  const bool found = search.solve();
  iterations_ = search.iterations();
  for (std::size_t i = 0; i < network.pretensions.size(); ++i) {
    const network::Span& span = network.spans[at(network.pretensions[i].span)];
    for (int k = 0; k < span.elements; ++k) network.elements[at(span.first_element + k)].length *= search.factors()[i];
  }
  describe_lengths(network, search, report);
  has_lengths_ = found;
  if (!found) report.message = failed_lengths(network, search);
  statics_.emplace(assembler_, t_, frame_);
  return found;
}

void Equilibrium::describe_lengths(const network::Network& network, const solve::PretensionSearch& search,
                                   Report& report) const {
  std::size_t told = 0;
  for (std::size_t i = 0; i < network.pretensions.size(); ++i) {
    const network::Pretension& pretension = network.pretensions[i];
    const auto [name, value] = found_of(scene_, network, pretension);
    const double tension = search.tensions()(static_cast<Eigen::Index>(i));
    report.pretensions.push_back({name, pretension.is_net, value, tension});
    if (told++ >= most_told) continue;
    tell(pretension.is_net ? fmt::format("net {}: slack {:.9g} for a mean tension of {:.6g} N", name, value, tension)
                           : fmt::format("cable {}: length {:.9g} m for {:.6g} N at its start", name, value, tension));
  }
  if (told > most_told) tell(fmt::format("and {} more lengths, which are in run.yaml", told - most_told));
}

std::string Equilibrium::failed_lengths(const network::Network& network, const solve::PretensionSearch& search) const {
  if (!search.has_equilibrium())
    return fmt::format("no unstretched lengths were found that give the tensions asked for: {}", search.failure());
  const network::Pretension& worst = network.pretensions[search.worst()];
  const Report::Pretension found = [&] {
    const auto [name, value] = found_of(scene_, network, worst);
    return Report::Pretension{name, worst.is_net, value, search.tensions()(static_cast<Eigen::Index>(search.worst()))};
  }();
  return fmt::format(
      "no unstretched lengths were found that give all tensions asked for: {}. Farthest off is {} {}, which has {:.4g} "
      "N "
      "{} in place of {:.4g} N, with {} {:.6g}{}",
      search.failure(), worst.is_net ? "net" : "cable", found.name, found.tension,
      worst.is_net ? "in the mean" : "at its start", worst.tension, worst.is_net ? "slack" : "length", found.value,
      search.is_least() ? "; that is about the least it can have" : "");
}

bool Equilibrium::find(const network::Network& network, Report& report) {
  const bool found = statics_->solve();
  report.statics = {frame_, statics_->imbalance(), statics_->largest_load(), iterations_ + statics_->iterations(),
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

const char* Equilibrium::advice() const {
  if (!has_lengths_) return lengths_advice;
  return statics_->is_there_without_pushing() ? slack_advice : general_advice;
}

void Equilibrium::add_notes(const network::Network& network, Report& report) {
  if (statics_->is_unstable()) add_note(report, "the equilibrium is not stable: a disturbance would leave it");
  add_note(report, note_of_pushing(network, statics_->pushing(), PETSC_COMM_WORLD));
  if (statics_->is_drag_lost())
    add_note(report,
             "the current is too weak to tell where cables lie on the bed without friction: its drag is as small as "
             "what is left of the forces; give seabed.friction, or no current");
  if (statics_->leaves_friction_out())
    add_note(report,
             "this equilibrium is without the bed's friction: with it cables would push, or nothing was found that "
             "stays; from here on friction holds what lies there");
  add_note(report, note_of_touchdown(network, statics_->on_bed(), PETSC_COMM_WORLD));
}

}   // namespace cablenet::app
