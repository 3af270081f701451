#include "cablenet/solve/dynamics.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cablenet/petsc/options.hpp"
#include "cablenet/solve/energy_watch.hpp"
#include "cablenet/solve/own_options.hpp"
#include "cablenet/system/losses.hpp"

namespace cablenet::solve {
namespace {

/// A run fails where its steps have shrunk to this part of the step that was asked for.
constexpr double smallest_step = 1e-10;

/// After so many steps the forces and the largest coordinate are measured again.  Newton's tolerances depend on them.
constexpr long steps_between_measures = 64;

}   // namespace

Dynamics::Dynamics(system::Assembler& assembler, const scene::Time& time, const Settings& settings)
    : assembler_(assembler),
      time_(time),
      newton_(assembler),
      stepper_(assembler, newton_, time, settings.most_steps, settings.prefix),
      schedule_(time.start, std::min(stepper_.end(), time.end), stepper_.first_step(), settings.output_interval),
      is_watched_(settings.is_watched && may_gain_energy(time, stepper_.weights())) {
  most_gained_ = read_number(most_gained_option, assembler.communicator(), settings.prefix, most_gained_, 0,
                             std::numeric_limits<double>::infinity());
  follow_energy(settings);
  time_.step = stepper_.first_step();
  if (settings.takes_notes) take_notes();
  if (!time.tolerance || petsc::has_option("-ts_adapt_type", settings.prefix)) return;
  const double span = time.end - time.start, interval = settings.output_interval;
  const double longest = interval > 0 ? std::min(interval, span) : span;
  control_.emplace(*time.tolerance, time_.step, longest, smallest_step * time_.step, stepper_.local_error().order());
  stepper_.control_errors([this](const auto& error, double dt) { return accepts(error(), dt); },
                          StepControl::refused_scale);
}

/// Accounts are for who asks for them, and for the watch where water, bed or damping take energy, too.  Else looks do.
/// What conserves energy is not looked at here, but where the state is observed anyway.
void Dynamics::follow_energy(const Settings& settings) {
  const bool is_simple = system::only_formulas_take_energy(assembler_.network(), assembler_.communicator());
  if (settings.keeps_accounts || (is_watched_ && !is_simple)) return assembler_.keep_accounts();
  if (!is_simple || !(is_watched_ || settings.takes_notes)) return;
  assembler_.keep_looks();
  looks_ = is_watched_ || damps(stepper_.weights());
}

void Dynamics::look_at_energy() {
  assembler_.observe(schedule_.time(), stepper_.x(), stepper_.v(), stepper_.a());
  assembler_.look_at_energy();
}

/// Whose own means adapt the steps judges them by those.
void Dynamics::take_notes() {
  assembler_.keep_tensions();
  if (stepper_.user_adapts()) return;
  survey_.emplace(assembler_.network());
  stepper_.local_error().add_means_to(survey_->means());
  if (time_.tolerance) return;
  stepper_.control_errors(
      [this](const auto& error, double dt) {
        survey(error, dt);
        return true;
      },
      1);
}

void Dynamics::survey(const AlphaStepper::Error& error, double dt) {
  const bool is_sample = StepSurvey::looks_at(counts_.steps);
  const bool is_event = survey_->is_event(counts_.steps, newton_.first_correction());
  if (!is_sample && !is_event) return;
  const double found = error();
  is_sample ? survey_->add_sample(found, dt, assembler_.communicator(), is_event)
            : survey_->add_event(dt, assembler_.communicator());
}

/// Of adaptive steps each is estimated, and stands for itself.
bool Dynamics::accepts(double error, double dt) {
  if (!control_->accepts(error, dt)) return false;
  if (survey_) survey_->add_event(dt, assembler_.communicator());
  return true;
}

/// M a0 = f(t0, x0, v0).
void Dynamics::start(const Observers& observers) {
  newton_.solve_acceleration(time_.start, stepper_.x(), stepper_.v(), stepper_.a());
  stepper_.restart();
  is_started_ = true;
  if (looks_) look_at_energy();
  observers.output(instant());
}

Verdict Dynamics::run(const Observers& observers) {
  if (!is_started_) start(observers);
  const long most_steps = stepper_.most_steps();
  Verdict verdict = Verdict::finished;
  while (verdict == Verdict::finished && !schedule_.at_end()) {
    if (counts_.steps >= most_steps || is_stopped_) {
      verdict = Verdict::stopped;
    } else if (!step(schedule_.next_step())) {
      verdict = Verdict::failed;
    } else {
      observers.step(schedule_.time(), last_step_, counts_);
      if (is_at_an_end(observers)) return Verdict::failed;
    }
  }
  stepper_.view();
  if (verdict == Verdict::finished) return schedule_.time() < time_.end ? Verdict::stopped : Verdict::finished;
  if (!schedule_.at_output()) observers.output(instant());
  return verdict;
}

/// After a step.  Where looks are kept it looks now and then, and at a run's end.
bool Dynamics::gains_energy() {
  if (looks_ && !looks_at_energy(counts_.steps) && !schedule_.at_end()) return false;
  if (looks_) look_at_energy();
  if (!is_watched_) return false;
  return solve::gains_energy(*assembler_.energy_summary(), newton_.energy_rounding(), most_gained_);
}

bool Dynamics::is_at_an_end(const Observers& observers) {
  const bool exhausted = last_step_ < smallest_step * time_.step;
  outside_body_ = assembler_.nearly_singular_body(stepper_.x());
  has_gained_energy_ = gains_energy();
  if (schedule_.at_output() || exhausted || outside_body_ >= 0 || has_gained_energy_) observers.output(instant());
  if (has_gained_energy_) return true;
  if (outside_body_ >= 0 || !exhausted) return outside_body_ >= 0;
  if (control_) failure_ = control_->refusal(last_step_);
  if (failure_.empty())
    failure_ = fmt::format("Newton's method succeeds only with steps as short as {:.3g} s", last_step_);
  return true;
}

bool Dynamics::step(double dt) {
  const double t = schedule_.time();
  newton_.begin_step(t, stepper_.x(), stepper_.v(), counts_.steps % steps_between_measures == 0);
  assembler_.begin_step(t, stepper_.x(), stepper_.v());
  stepper_.begin(t, dt);
  const AlphaStepper::Outcome outcome = stepper_.attempt();
  newton_.end_step(outcome.newton);
  counts_.rejected += outcome.rejected;
  counts_.newton += outcome.newton;
  counts_.linear += outcome.linear;
  outcome.is_done ? accept(t, outcome) : explain_failure(outcome.next);
  return outcome.is_done;
}

void Dynamics::accept(double t, const AlphaStepper::Outcome& outcome) {
  last_step_ = outcome.taken;
  if (survey_) survey_->end_step(counts_.steps, outcome.taken, stepper_.x());
  ++counts_.steps;
  assembler_.end_step({t, outcome.taken, stepper_.step().alpha_f}, stepper_.x(), stepper_.v());
  stepper_.accept(outcome.taken);
  schedule_.advance(outcome.taken, outcome.is_retried);
  if (control_) control_->advance(outcome.is_retried);
  if (control_ || stepper_.user_adapts()) schedule_.set_limit(control_ ? control_->limit() : outcome.next);
  stepper_.monitor(counts_.steps, schedule_.time());
}

void Dynamics::explain_failure(double dt) {
  failure_ = newton_.has_converged() && control_ ? control_->refusal(stepper_.step().dt) : newton_.explain_failure(dt);
}

std::optional<StepFindings> Dynamics::step_findings() {
  if (!survey_) return std::nullopt;
  return survey_->findings(stepper_.local_error().order(), control_.has_value(), assembler_.communicator());
}

void Dynamics::archive(Archive& archive) {
  archive.item("counts.steps", counts_.steps);
  archive.item("counts.rejected", counts_.rejected);
  archive.item("counts.newton", counts_.newton);
  archive.item("counts.linear", counts_.linear);
  schedule_.archive(archive);
  if (control_) control_->archive(archive);
  if (survey_) survey_->archive(archive);
  newton_.archive(archive);
  stepper_.archive(archive);
  assembler_.archive(archive);
  is_started_ = true;
}

}   // namespace cablenet::solve
