#include <fmt/format.h>

#include "cablenet/app/run_notes.hpp"

namespace cablenet::app {
namespace {

/// A period, or a step in water, may err by so much of the motion before it is worth a note.
constexpr double most_of_motion = 0.03, most_in_water = 0.01;
/// By so much it errs with the step that is recommended.
constexpr double good_of_motion = 0.01, good_in_water = 0.001;

/// Rejected attempts: at least so many, and this part of all.
constexpr long most_rejected = 2;
constexpr double most_of_attempts = 0.02;

std::string percent(double share) { return share > 1 ? "more than 100 %" : fmt::format("{:.2g} %", 100 * share); }

std::string too_long(const solve::StepFindings& steps) {
  const bool adds_up = steps.adds_up();
  const double good = adds_up ? good_of_motion : good_in_water;
  return fmt::format(
      "the steps do not resolve this motion: {} they lead it astray by some {} of its way, which is {:.3g} m; steps of "
      "{:.1g} s would by {}",
      adds_up ? "in each of its periods" : "each by itself", percent(steps.share()), steps.motion, steps.step_for(good),
      percent(good));
}

}   // namespace

std::vector<std::string> step_notes(const solve::StepFindings& steps, const solve::Counts& counts) {
  std::vector<std::string> notes;
  if (steps.share() > (steps.adds_up() ? most_of_motion : most_in_water)) notes.push_back(too_long(steps));
  const long attempts = counts.steps + counts.rejected;
  if (counts.rejected > most_rejected &&
      static_cast<double>(counts.rejected) > most_of_attempts * static_cast<double>(attempts))
    notes.push_back(fmt::format(
        "{} of {} attempts at steps failed, and steps became as short as {:.2g} s: the steps do not resolve "
        "this motion, and other rank counts may give other results; try a smaller time.step",
        counts.rejected, attempts, steps.shortest));
  return notes;
}

}   // namespace cablenet::app
