#pragma once
#include <petsclog.h>

/// The parts of a step that PETSc's -log_view tells apart.
namespace cablenet::petsc {

enum class Phase { exchange, residual, tangent, factor, solve };

/// Names the phases to PETSc, once, before the first Timer.  Collective.
void register_phases();

/// Counts the time from construction to destruction; costs next to nothing unless -log_view is on.
class Timer {
public:
  explicit Timer(Phase phase);
  ~Timer();
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;

private:
  PetscLogEvent event_;
};

}   // namespace cablenet::petsc
