#include "cablenet/solve/local_error.hpp"

#include <algorithm>
#include <cmath>

#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/petsc/handle.hpp"

namespace cablenet::solve {
namespace {

using petsc::check;

/// The time at which the true motion has the acceleration that is kept after the step, counted from the step's end [s].
/// A mean belongs to the step's middle.  Otherwise it follows from the stage: there the method balances forces, so that
/// the true motion has the acceleration (1 - alpha_m) a0 + alpha_m a1.
/// @param before  likewise of a0, counted from the step's start [s]
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

/// a1 - a0 = (x1 - x0 - dt v0 - dt^2/2 a0) / (beta dt^2).  Where means are kept, 1/2 takes the place of beta.
double LocalError::estimate(const AlphaStep& step, const partition::LocalNetwork& network, const StepStart& start,
                            Vec x1) {
  next_a_time_ = acceleration_time(step, a_time_);
  const double constant = std::abs(step.beta + (step.alpha_f - step.alpha_m) / 2 - 1.0 / 6);
  const double beta = step.alternates() ? 0.5 : step.beta;
  const double share = constant * step.dt / (beta * (step.dt + next_a_time_ - a_time_));
  return share * largest_correction(network, start, step.dt, x1);
}

}   // namespace cablenet::solve
