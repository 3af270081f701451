#pragma once
#include <petscts.h>

#include <optional>
#include <string>

#include "cablenet/scene/scene.hpp"
#include "cablenet/solve/alpha_step.hpp"
#include "cablenet/solve/defaults.hpp"
#include "cablenet/solve/newton_convergence.hpp"
#include "cablenet/solve/observers.hpp"
#include "cablenet/solve/schedule.hpp"
#include "cablenet/solve/step_control.hpp"
#include "cablenet/solve/tangent_reuse.hpp"
#include "cablenet/system/assembler.hpp"

/// A run through time with PETSc's TSALPHA2.  Tests: tests/parallel/dynamics_test.cpp, tests/verification
namespace cablenet::solve {

using TimeStepper = petsc::Handle<TS, TSDestroy>;

/// All member functions are collective.
class Dynamics {
public:
  /// Reads the options database (-ts_*, -snes_*, -ksp_*, -pc_*), all of them with a prefix where one is given.
  Dynamics(system::Assembler& assembler, const scene::Time& time, double output_interval, const char* prefix = nullptr);

  Verdict run(const Observers& observers);

  const Counts& counts() const { return counts_; }
  std::string linear_solver() const;
  /// Why the last attempt failed, e.g. "Newton's method did not converge (DIVERGED_MAX_IT)".
  const std::string& failure() const { return failure_; }
  /// Where (on any rank) the failed attempt's residual was worst or undefined.
  FailedPart failed_part();

private:
  void create_stepper(const char* prefix);
  void configure_solvers();
  void read_limits();
  bool follows_residuals_by_tangents() const;
  void solve_initial_acceleration();
  bool step(double dt);
  void accept(double t, double taken, bool retried);
  void update_acceleration(double dt);
  system::TangentRequest tangent_request();
  bool is_at_rounding(PetscInt iteration, double norm);
  system::Stage stage() const { return {schedule_.time(), alpha_.dt, alpha_.alpha_f}; }
  Instant instant() const;
  void explain_failure();
  void choose_line_search(bool retry);

  static PetscErrorCode residual(TS, PetscReal t, Vec x, Vec v, Vec a, Vec r, void* self) noexcept;
  static PetscErrorCode jacobian(TS, PetscReal t, Vec x, Vec v, Vec a, PetscReal shift_v, PetscReal shift_a, Mat J,
                                 Mat P, void* self) noexcept;
  static PetscErrorCode predict(SNES, Vec x, void* self) noexcept;
  static PetscErrorCode converged(SNES, PetscInt iteration, PetscReal xnorm, PetscReal snorm, PetscReal fnorm,
                                  SNESConvergedReason* reason, void* self) noexcept;
  static PetscErrorCode before_stage(TS, PetscReal t) noexcept;
  static PetscErrorCode check_error(TSAdapt, TS, PetscReal t, Vec x, PetscBool* accept) noexcept;

  system::Assembler& assembler_;
  scene::Time time_;
  Schedule schedule_;
  std::optional<StepControl> control_;   ///< of adaptive steps
  system::ForceScales scales_;
  system::Vector x_, v_, a_;   ///< a_: what is reported and predicted with
  system::Vector x0_, v0_;     ///< at the step's start
  system::Vector start_acceleration_;
  system::TangentMatrix tangent_;
  LinearSolver linear_;
  TimeStepper stepper_;
  SNES snes_ = nullptr;   ///< the stepper's
  KSP ksp_ = nullptr;
  TangentReuse reuse_;
  AlphaStep alpha_{};               ///< of the running Newton solve
  int evaluations_ = 0;             ///< of the residual in it
  petsc::VectorState tangent_at_;   ///< of the x at which a residual brought its tangent along
  int expected_newton_ = 1;         ///< as many as the last step took
  Counts counts_;
  std::string failure_;
  SolverNumber failed_node_;   ///< where the tangent was singular
  double furthest_ = 0;        ///< largest coordinate [m]
  NewtonConvergence convergence_;
  double last_step_ = 0;      ///< [s]
  int outside_domain_ = -1;   ///< scene number of an element that lost its length in the running step
  int outside_body_ = -1;     ///< likewise of a body that turned out of its domain
  int attempts_ = 0;          ///< of the running step
  bool keeps_mean_acceleration_ = false;
  bool combines_ = false;   ///< each residual but a solve's last is followed by its tangent
  bool user_adapts_ = false;
  bool user_line_search_ = false;
};

}   // namespace cablenet::solve
