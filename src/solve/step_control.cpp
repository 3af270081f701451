#include "cablenet/solve/step_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/petsc/handle.hpp"

namespace cablenet::solve {
namespace {

using petsc::check;

constexpr double rounding = 1e-6;   // of a step

/// Of the tolerance: what a doubled step's error may be expected to reach.
constexpr double safety = 0.5;

/// Of a step whose error is beyond the tolerance.
constexpr double refused_scale = 0.5;

/// A step that grows at once may have to shrink at once.
constexpr int steps_before_growth = 3;

/// The method balances forces at the stage, where its acceleration is (1 - alpha_m) a0 + alpha_m a1; a mean is that of
/// the step's middle.  [s from the step's end]
double acceleration_time(const AlphaStep& step, double before) {
  if (step.alternates()) return -step.dt / 2;
  return (step.alpha_f * step.dt - (1 - step.alpha_m) * before) / step.alpha_m - step.dt;
}

/// Of all nodes, the largest |x1 - x0 - dt v0 - dt^2/2 a0|.  [m]
double largest_correction(const partition::LocalNetwork& network, const StepStart& start, double dt, Vec x1) {
  const double *x1_values = nullptr, *x = nullptr, *v = nullptr, *a = nullptr;
  check(VecGetArrayRead(x1, &x1_values));
  check(VecGetArrayRead(start.x, &x));
  check(VecGetArrayRead(start.v, &v));
  check(VecGetArrayRead(start.a, &a));
  double largest = 0;
  for (LocalNode node(0); network.is_owned(node); ++node) {
    const auto of_node = [begin = network.begin[node].value()](const double* values) {
      return Eigen::Map<const Vector3>(values + begin);
    };
    const Vector3 correction = of_node(x1_values) - of_node(x) - dt * of_node(v) - dt * dt / 2 * of_node(a);
    largest = std::max(largest, correction.norm());
  }
  check(VecRestoreArrayRead(x1, &x1_values));
  check(VecRestoreArrayRead(start.x, &x));
  check(VecRestoreArrayRead(start.v, &v));
  check(VecRestoreArrayRead(start.a, &a));
  MPI_Comm communicator = MPI_COMM_NULL;
  check(PetscObjectGetComm(reinterpret_cast<PetscObject>(x1), &communicator));
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, communicator);
  return largest;
}

}   // namespace

StepControl::StepControl(TSAdapt adapt, double tolerance, double first, double longest, double shortest)
    : adapt_(adapt), tolerance_(tolerance), limit_(std::min(first, longest)), longest_(longest), shortest_(shortest) {
  check(TSAdaptGetScaleSolveFailed(adapt_, &newton_scale_));
}

void StepControl::begin_attempt() { check(TSAdaptSetScaleSolveFailed(adapt_, newton_scale_)); }

/// a1 - a0 is the correction of x0 + dt v0 + dt^2/2 a0 over beta dt^2, beta that of the mean being 1/2.
bool StepControl::accepts(const AlphaStep& step, const partition::LocalNetwork& network, const StepStart& start,
                          Vec x1) {
  dt_ = step.dt;
  next_a_time_ = acceleration_time(step, a_time_);
  const double constant = std::abs(step.beta + (step.alpha_f - step.alpha_m) / 2 - 1.0 / 6);
  const double beta = step.alternates() ? 0.5 : step.beta;
  const double share = constant * dt_ / (beta * (dt_ + next_a_time_ - a_time_));
  error_ = share * largest_correction(network, start, dt_, x1);
  if (error_ <= tolerance_ || dt_ < shortest_) return true;
  refused_error_ = error_;
  refused_dt_ = dt_;
  check(TSAdaptSetScaleSolveFailed(adapt_, refused_scale));
  return false;
}

void StepControl::advance(bool retried) {
  a_time_ = next_a_time_;
  const double wanted = std::min(2 * limit_, longest_), growth = wanted / dt_;
  const bool grows = !retried && wanted > limit_ && error_ * growth * growth * growth <= safety * tolerance_;
  growing_ = grows ? growing_ + 1 : 0;
  if (retried) limit_ = std::min(limit_, dt_);
  if (growing_ < steps_before_growth) return;
  limit_ = wanted;
  growing_ = 0;
}

std::string StepControl::refusal(double dt) const {
  if (refused_dt_ == 0 || refused_dt_ * refused_scale > dt * (1 + rounding)) return "";
  return fmt::format("a step of {:.3g} s alone errs by {:.3g} m, which is beyond the tolerance of {:.3g} m",
                     refused_dt_, refused_error_, tolerance_);
}

}   // namespace cablenet::solve
