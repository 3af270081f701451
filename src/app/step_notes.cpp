#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cablenet/app/run_notes.hpp"

namespace cablenet::app {
namespace {

/// A period, or a step in water, may err by so much of the motion before it is worth a note.
constexpr double most_of_motion = 0.03, most_in_water = 0.01;
/// So may a whole run whose errors add up.  Some of them cancel.
constexpr double most_of_run = 0.05;
/// By so much it errs with the step that is recommended.
constexpr double good_of_motion = 0.01, good_in_water = 0.001;

/// Rejected attempts: at least so many, and this part of all.
constexpr long most_rejected = 2;
constexpr double most_of_attempts = 0.02;

/// What errors add up over.
const char* span(const solve::StepFindings& steps) {
  return steps.ways() > solve::StepFindings::counted_ways ? "ten of its periods" : "this run";
}

std::string percent(double share) { return share > 1 ? "more than 100 %" : fmt::format("{:.2g} %", 100 * share); }

/// Of what adds up over the run; both parts are of second order.  [s]
double step_for_run(const solve::StepFindings& steps, double share) {
  return steps.step * std::sqrt(good_of_motion / share);
}

/// @param run_share  what adds up over the run
std::string too_long(const solve::StepFindings& steps, double run_share) {
  const bool adds_up = steps.adds_up();
  const double good = adds_up ? good_of_motion : good_in_water;
  std::string text = fmt::format(
      "the steps do not resolve this motion: {} they lead it astray by some {} of its way, which is {:.3g} m; steps of "
      "{:.1g} s would by {}",
      adds_up ? "in each of its periods" : "each by itself", percent(steps.share()), steps.motion, steps.step_for(good),
      percent(good));
  if (run_share > most_of_run)
    text += fmt::format(", and in {} steps of {:.1g} s would", span(steps), step_for_run(steps, run_share));
  return text;
}

std::string adds_up_too_far(const solve::StepFindings& steps, double run_share) {
  const bool is_lag = run_share > 2 * steps.total_share();
  return fmt::format(
      "the steps do not resolve this motion: in {} their errors add up{} to some {} of its way, which is {:.3g} m; "
      "steps of {:.1g} s would come to {}",
      span(steps), is_lag ? ", most of it by what their formulas take of the energy," : "", percent(run_share),
      steps.way, step_for_run(steps, run_share), percent(good_of_motion));
}

}   // namespace

double step_for_accuracy(const solve::StepFindings& steps, double lost) {
  const double run_share = steps.total_share() + steps.lag(std::abs(lost));
  double step = steps.share() > 0 ? steps.step_for(steps.adds_up() ? good_of_motion : good_in_water) : 0;
  if (run_share > 0) step = std::min(step, step_for_run(steps, run_share));
  return step;
}

std::vector<std::string> step_notes(const solve::StepFindings& steps, const solve::Counts& counts, double lost) {
  std::vector<std::string> notes;
  if (steps.is_adaptive) return notes;
  const double run_share = steps.total_share() + steps.lag(std::abs(lost));
  if (steps.share() > (steps.adds_up() ? most_of_motion : most_in_water))
    notes.push_back(too_long(steps, run_share));
  else if (run_share > most_of_run)
    notes.push_back(adds_up_too_far(steps, run_share));
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
