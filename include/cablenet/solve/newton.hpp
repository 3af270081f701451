#pragma once
#include <petscsnes.h>

#include <optional>
#include <string>

#include "cablenet/petsc/object_state.hpp"
#include "cablenet/solve/curvature_probe.hpp"
#include "cablenet/solve/linear_solver.hpp"
#include "cablenet/solve/newton_convergence.hpp"
#include "cablenet/solve/newton_progress.hpp"
#include "cablenet/solve/observers.hpp"
#include "cablenet/solve/stage_equations.hpp"
#include "cablenet/solve/tangent_reuse.hpp"
#include "cablenet/system/assembler.hpp"

namespace cablenet::solve {

/// Newton's method for a network's equations at a stage, with PETSc's SNES.
///
/// The first guess is x0 + dt v0 + dt^2/2 a with the acceleration a that the step may be expected to have.  The
/// iteration ends where the residual is down to rounding (NewtonConvergence) or to PETSc's tolerances.  It fails where
/// it gets no nearer (NewtonProgress).
///
/// Attempts at a step differ in the tension that turns the chords in the tangent (system::TurningRule).  The first
/// takes the predicted one, the second does so without compression, and the third has the tangent of the equations.
/// Later ones are like the second, and shorter.  From the fifth on they search along the line of a correction.
///
/// This class makes the tangents itself, in the convergence test, and tells SNES never to make one: SNES's own way to
/// a tangent looks up options, which costs a fifth of a small step.  Where an option of the user's needs SNES to make
/// tangents, SNES makes them.
///
/// All member functions are collective.  Tests: tests/parallel/dynamics_test.cpp, tangent_reuse_test.cpp
class Newton final : public StageEquations {
public:
  explicit Newton(system::Assembler& assembler);

  void configure(SNES snes) override;
  void adopt_options() override;
  void begin_attempt(int attempt) override;
  void begin_solve(const AlphaStep& step, const StepStart& start, Vec guess) override;
  void residual(Vec x, Vec v, Vec a, Vec r) override;
  void tangent() override;
  Mat tangent_matrix() const override { return tangent_.matrix(); }

  /// M a = f(t, x, v).  @throws SolverError
  void solve_acceleration(double t, Vec x, Vec v, Vec a);
  /// Before each step.
  /// @param measures  whether to measure the forces and the largest coordinate, on which tolerances depend
  void begin_step(double t, Vec x, Vec v, bool measures);
  /// @param iterations  of all solves of the step
  void end_step(long iterations);

  /// Of the last solve: how far its first guess was off [m].  0: not at all.
  double first_correction() const { return first_correction_; }
  /// Why the last solve failed.  @param dt  of the last attempt [s]
  std::string explain_failure(double dt);
  bool has_converged() const;
  /// Where the last residual was worst or undefined, on any rank.
  /// @param known_body  in Network::bodies, of one that is known to have left its domain, or -1
  FailedPart failed_part(int known_body);
  std::string linear_solver() const { return linear_.describe(); }
  /// What rounding of positions does to stored energy: eps |x| times the loads.  [J]
  double energy_rounding() const { return PETSC_MACHINE_EPSILON * largest_coordinate_ * scales_.load; }

  /// What the next step's path depends on.
  void archive(Archive& archive);

private:
  bool makes_tangents(const char* prefix) const;
  bool has_basic_line_search() const;
  void scale_tolerance();
  void choose_line_search(bool searches);
  /// The 2-norm of a residual that is rounding alone.  [N]
  double noise() const { return scales_.rounding(largest_coordinate_, step_.shift_a()) / step_.alpha_f; }
  bool is_at_rounding(PetscInt iteration, double norm, double correction, double noise);
  SNESConvergedReason test(PetscInt iteration, PetscReal xnorm, PetscReal snorm, PetscReal fnorm);
  system::TangentRequest tangent_request();
  bool predicts() const;
  bool clamps() const;
  system::TurningRule turning() const;
  /// The last tangent is not that of the equations: it was kept, or compression turns nothing in it.
  bool converges_linearly() const { return reuse_.was_kept() || clamps(); }
  void shorten_where_it_returns();
  bool is_at_positions_rounding(double correction, double positions) const;
  system::Stage stage() const { return {t_, step_.dt, step_.alpha_f}; }
  static PetscErrorCode converged(SNES, PetscInt iteration, PetscReal xnorm, PetscReal snorm, PetscReal fnorm,
                                  SNESConvergedReason* reason, void* self) noexcept;

  system::Assembler& assembler_;
  system::ForceScales scales_;
  system::TangentMatrix tangent_;
  LinearSolver linear_;
  SNES snes_ = nullptr;
  TangentReuse reuse_;
  NewtonConvergence convergence_;
  CurvatureProbe probe_;
  NewtonProgress progress_;
  AlphaStep step_{};
  double t_ = 0;                                  ///< of the step's start [s]
  Vec x_ = nullptr, v_ = nullptr, a_ = nullptr;   ///< at the stage of the last residual
  petsc::VectorState tangent_at_;                 ///< of the x at which a residual brought its tangent along
  long evaluations_ = 0;                          ///< of the residual in the running solve
  long tangents_ = 0;                             ///< of the running solve
  long expected_iterations_ = 1;                  ///< as many as the last step took
  double largest_coordinate_ = 0;                 ///< [m]
  double first_correction_ = 0;                   ///< [m]
  int outside_element_ = -1;     ///< scene number of an element that lost its length in the running attempt
  int outside_body_ = -1;        ///< likewise of a body that turned out of its domain
  SolverNumber singular_node_;   ///< solver number: where the tangent was singular
  int attempt_ = 0;              ///< at the running step, from 1 on
  bool searches_ = false;        ///< along its corrections
  double length_ = 1;            ///< of the next correction, over the whole one
  bool makes_tangents_ = false;
  bool combines_ = false;   ///< each residual but a solve's last brings its tangent along
  bool user_line_search_ = false;
};

}   // namespace cablenet::solve
