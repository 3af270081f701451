#pragma once
#include <petscsnes.h>

#include "cablenet/solve/local_error.hpp"

namespace cablenet::solve {

/// What a time stepper asks of the equations of motion and of the method that solves them at a stage.  All member
/// functions are collective.
class StageEquations {
public:
  virtual ~StageEquations() = default;

  /// Before any step: sets the solver up.  The user's options are read next, and adopt_options() follows.
  virtual void configure(SNES snes) = 0;
  virtual void adopt_options() = 0;

  /// @param attempt  at the running step, from 1 on; the first three have the same length
  virtual void begin_attempt(int attempt) = 0;
  /// @param start  of the step
  /// @param guess  the positions at the step's start, and a guess of those at its end when this returns
  virtual void begin_solve(const AlphaStep& step, const StepStart& start, Vec guess) = 0;
  /// r = the residual at the stage [N].  Infinite where it is undefined.
  virtual void residual(Vec x, Vec v, Vec a, Vec r) = 0;
  /// Computes the tangent at the last residual's stage, for a solver that asks for it.
  virtual void tangent() = 0;
  virtual Mat tangent_matrix() const = 0;
};

}   // namespace cablenet::solve
