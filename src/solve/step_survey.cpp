#include "cablenet/solve/step_survey.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cablenet/petsc/values.hpp"
#include "cablenet/solve/local_error.hpp"

namespace cablenet::solve {

double StepFindings::share() const {
  if (motion <= 0) return 0;
  return (adds_up() ? 2 * std::numbers::pi / LocalError::memory : 1) * error / motion;
}

double StepFindings::step_for(double wanted) const { return step * std::pow(wanted / share(), 1.0 / order); }

void StepSurvey::end_step(long steps, double dt, Vec x) {
  shortest_ = shortest_ == 0 ? dt : std::min(shortest_, dt);
  if (!looks_at(steps)) return;
  ++looked_at_;
  step_ += dt;
  const petsc::ReadValues values(x);
  double furthest = 0;
  for (LocalNode node(0); network_.is_owned(node); ++node) {
    const Eigen::Map<const Vector3> here(values + network_.begin[node].value());
    furthest = std::max(furthest, (here - network_.position[node]).squaredNorm());
  }
  motion_ = std::max(motion_, std::sqrt(furthest));
}

StepFindings StepSurvey::findings(int order, MPI_Comm communicator) const {
  double motion = motion_;
  MPI_Allreduce(MPI_IN_PLACE, &motion, 1, MPI_DOUBLE, MPI_MAX, communicator);
  const double by = 1 / static_cast<double>(std::max(looked_at_, 1L));
  return {looked_at_, by * error_, by * step_, motion, shortest_, order};
}

void StepSurvey::archive(Archive& archive) {
  archive.item("survey.looked_at", looked_at_);
  archive.item("survey.error", error_);
  archive.item("survey.step", step_);
  archive.item("survey.motion", motion_);
  archive.item("survey.shortest", shortest_);
}

}   // namespace cablenet::solve
