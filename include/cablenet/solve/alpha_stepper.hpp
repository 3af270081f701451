#pragma once
#include <petscts.h>

#include <functional>

#include "cablenet/petsc/handle.hpp"
#include "cablenet/scene/time.hpp"
#include "cablenet/solve/mean_acceleration.hpp"
#include "cablenet/solve/stage_equations.hpp"
#include "cablenet/system/assembler.hpp"

/// PETSc's TSALPHA2, and all that the program knows of it: nothing else calls a function of TS.
///
/// The first acceleration a0.  TSALPHA2 cannot be told a0.  It estimates a0 by two steps of dt/2 with weights of their
/// own (AlphaWeights::is_start).  With the equations of motion that estimate would be wrong before PETSc 3.22, and of
/// first order in dt since.  So TSALPHA2 gets another residual in those two steps: a - c a0, with the true a0 and with
/// the factor c that makes its estimate a0 to rounding.  It does the same again after restart().
///
/// Tests: tests/parallel/dynamics_test.cpp, resume_test.cpp
namespace cablenet::solve {

using TimeStepper = petsc::Handle<TS, TSDestroy>;

/// All member functions are collective.
class AlphaStepper {
public:
  /// What a step came to, after PETSc's own retries with shorter steps.
  struct Outcome {
    bool is_done;
    bool is_retried;   ///< an attempt was rejected, and a shorter one followed
    double taken;      ///< [s]
    double next;       ///< the last attempt's length, or what the user's -ts_adapt_type wants next [s]
    long rejected, newton, linear;
  };

  /// Starts from the assembler's start.  Reads the options database (-ts_*, -snes_*, -ksp_*, -pc_*).
  /// @param most_steps  where -ts_max_steps is not given
  /// @param prefix      of all options, or nullptr
  AlphaStepper(const system::Assembler& assembler, StageEquations& equations, const scene::Time& time, long most_steps,
               const char* prefix);

  /// Where the user asked for -help, PETSc shows the options of a stepper and its solvers.
  static void show_options(MPI_Comm communicator);

  /// The scene's times, or what the user's options made of them.
  double first_step() const;
  double end() const;
  long most_steps() const;
  /// The user's -ts_adapt_type chooses the steps.
  bool user_adapts() const { return user_adapts_; }

  /// Estimates the local error of an attempt [m].  Collective.
  using Error = std::function<double()>;
  /// `accepts` is told the local error, for which it has to ask, and the length [s] of each attempt.  Where it answers
  /// false the attempt is refused, and the next one is `scale` times as long.
  void control_errors(std::function<bool(const Error&, double dt)> accepts, double scale);
  /// The next step starts with the acceleration a() instead of the one that TSALPHA2 keeps.
  void restart();

  /// Sets up a step from t, of length dt [s].
  void begin(double t, double dt);
  Outcome attempt();
  /// Ends a step that was taken: computes a() from x() and from v(), which the caller may have changed.
  /// @param taken  the length of the step [s]
  void accept(double taken);
  /// Runs the user's monitors.
  void monitor(long step, double t);
  /// Shows the stepper where the user asked for -ts_view.
  void view();

  Vec x() const { return x_; }   ///< [m]
  Vec v() const { return v_; }   ///< [m/s]
  /// The step's mean where the method is centred, else the method's own.  [m/s^2]
  Vec a() const { return a_; }
  /// The scene's, or what the user's options made of them.
  AlphaWeights weights() const { return read_step(); }
  /// The weights and the length of the last attempt.
  const AlphaStep& step() const { return step_; }
  LocalError& local_error() { return local_error_; }

  /// x, v, a.  Saving restarts, so that this run and one that resumes from the archive go on alike.
  void archive(Archive& archive);

private:
  void configure(const scene::Time& time, long most_steps, const char* prefix);
  void restart_with(Vec acceleration);
  void limit_own_acceleration(double dt);
  StepStart step_start() const;
  AlphaStep read_step() const;
  bool accepts_error();

  static PetscErrorCode residual(TS, PetscReal t, Vec x, Vec v, Vec a, Vec r, void* self) noexcept;
  static PetscErrorCode jacobian(TS, PetscReal t, Vec x, Vec v, Vec a, PetscReal shift_v, PetscReal shift_a, Mat J,
                                 Mat P, void* self) noexcept;
  static PetscErrorCode begin_solve(SNES, Vec x, void* self) noexcept;
  static PetscErrorCode begin_stage(TS, PetscReal t) noexcept;
  static PetscErrorCode check_error(TSAdapt, TS, PetscReal t, Vec x, PetscBool* accept) noexcept;

  const partition::LocalNetwork& network_;
  StageEquations& equations_;
  system::Vector x_, v_, a_;
  system::Vector expected_a_, own_a_;             ///< of StepStart, where they are needed
  system::Vector x0_, v0_, start_acceleration_;   ///< at the step's start
  TimeStepper stepper_;
  SNES snes_ = nullptr;   ///< the stepper's
  TSAdapt adapt_ = nullptr;
  AlphaStep step_{};
  bool keeps_mean_acceleration_ = false, keeps_own_acceleration_ = false;
  bool shows_while_solving_ = true, user_adapts_ = false;
  int attempts_ = 0, repeats_ = 0;      ///< at the running step; a repeat has the same length
  double t_ = 0, dt_ = 0, taken_ = 0;   ///< of the running step [s], and the length of the last; 0: there was none
  long rejected_ = 0, newton_ = 0, linear_ = 0;   ///< so far
  std::function<bool(const Error&, double)> accepts_;
  PetscReal failed_scale_ = 1;   ///< the length of the next attempt over one at which Newton's method failed
  MeanAcceleration mean_acceleration_;
  LocalError local_error_;
  double refused_scale_ = 1;
};

}   // namespace cablenet::solve
