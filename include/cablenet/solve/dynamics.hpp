#pragma once
#include <limits>
#include <optional>
#include <string>

#include "cablenet/scene/time.hpp"
#include "cablenet/solve/alpha_stepper.hpp"
#include "cablenet/solve/newton.hpp"
#include "cablenet/solve/observers.hpp"
#include "cablenet/solve/schedule.hpp"
#include "cablenet/solve/step_control.hpp"
#include "cablenet/solve/step_survey.hpp"

/// A run through time: a schedule, adaptive control, observers and the explanation of failures around a time stepper
/// (alpha_stepper.hpp) and Newton's method (newton.hpp).
/// Tests: tests/parallel/dynamics_test.cpp, resume_test.cpp, tests/verification
namespace cablenet::solve {

/// All member functions are collective.
class Dynamics {
public:
  struct Settings {
    double output_interval = 0;                          ///< [s]; 0: every step
    const char* prefix = nullptr;                        ///< of all options
    long most_steps = std::numeric_limits<int>::max();   ///< where -ts_max_steps is not given
    bool keeps_accounts = false;                         ///< of energy
    bool is_watched = true;                              ///< where the scheme may gain energy
    bool takes_notes = false;                            ///< of tensions (Assembler::tensions) and steps
  };

  /// Reads the options database (-ts_*, -snes_*, -ksp_*, -pc_*, -mat_mumps_*, -cable_elimination_limit).
  /// @throws InputError for a value that is not allowed
  Dynamics(system::Assembler& assembler, const scene::Time& time, const Settings& settings);

  /// Goes from the start, or from what was loaded, to the end.
  Verdict run(const Observers& observers);
  /// The run ends after this step, with Verdict::stopped.  An observer calls it, on all ranks.
  void stop() { is_stopped_ = true; }

  const Counts& counts() const { return counts_; }
  std::string linear_solver() const { return newton_.linear_solver(); }
  /// Why the last attempt failed, e.g. "Newton's method failed (DIVERGED_MAX_IT) with steps down to 1e-5 s".
  const std::string& failure() const { return failure_; }
  /// Where (on any rank) the failed attempt's residual was worst or undefined.
  FailedPart failed_part() { return newton_.failed_part(outside_body_); }

  /// How well the steps so far have followed the motion.  Nothing where no notes are taken, or where
  /// the user's -ts_adapt_type chooses them.
  std::optional<StepFindings> step_findings();

  /// The scheme may gain energy, and the run ends where it does.
  bool is_watched() const { return is_watched_; }
  /// The run ended as its scheme brought energy in from nowhere.
  bool has_gained_energy() const { return has_gained_energy_; }

  /// Saves or loads t, x, v, a, what the terms keep, and all else that the further path depends on.  To be called
  /// between steps: before run(), or by an observer of steps.  Saving restarts the stepper, which changes the further
  /// path by rounding.  From there on the run that saved and a run that loads take the same path.  On the same number
  /// of ranks their numbers are equal bit for bit.
  /// @throws InputError if what is loaded does not fit
  void archive(Archive& archive);

private:
  void take_notes();
  void survey(const AlphaStepper::Error& error, double dt);
  bool accepts(double error, double dt);
  void follow_energy(const Settings& settings);
  void look_at_energy();
  bool gains_energy();
  void start(const Observers& observers);
  bool step(double dt);
  void accept(double t, const AlphaStepper::Outcome& outcome);
  /// After a step: whether the run has to fail, though the step did not.
  bool is_at_an_end(const Observers& observers);
  void explain_failure(double dt);
  Instant instant() const { return {schedule_.time(), counts_.steps, stepper_.x(), stepper_.v(), stepper_.a()}; }

  system::Assembler& assembler_;
  scene::Time time_;
  Newton newton_;
  AlphaStepper stepper_;
  Schedule schedule_;
  std::optional<StepControl> control_;   ///< of adaptive steps
  std::optional<StepSurvey> survey_;     ///< where notes are taken
  Counts counts_;
  bool is_started_ = false, is_stopped_ = false;
  double last_step_ = 0;    ///< [s]
  int outside_body_ = -1;   ///< in Network::bodies, of one that the last step brought too near to a singular attitude
  std::string failure_;
  bool is_watched_;
  bool looks_ = false;   ///< at energies, once in several steps
  bool has_gained_energy_ = false;
  double most_gained_ = 0.05;   ///< over what the run moves
};

}   // namespace cablenet::solve
