#include "cablenet/solve/local_error.hpp"

#include <algorithm>
#include <cmath>

#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/petsc/values.hpp"

namespace cablenet::solve {
namespace {

using petsc::check;

/// The time at which the true motion has the acceleration that is kept after the step, counted from the step's end [s].
/// A mean belongs to the step's middle.  Otherwise it follows from the stage: there the method balances forces, so that
/// the true motion has the acceleration (1 - alpha_m) a0 + alpha_m a1.
/// @param before  likewise of a0, counted from the step's start [s]
double acceleration_time(const AlphaStep& step, double before) {
  if (step.is_centred()) return -step.dt / 2;
  return (step.alpha_f * step.dt - (1 - step.alpha_m) * before) / step.alpha_m - step.dt;
}

/// Radians of a motion over which the errors of its steps add up.
constexpr double memory = 2;

/// |x'''| times the time over which a step's error counts [m/s^2]: that in which the motion turns by `memory`, at most
/// `longest`, at least the step.  A radian takes |x''|/|x'''| or sqrt(|x'|/|x'''|), the shorter one: the first is right
/// in a uniform motion, the second in a uniform acceleration.
double weighed_jerk(double dt, double longest, const Vector3& v, const Vector3& a, const Vector3& jerk) {
  const double third = jerk.norm(), over_radian = memory * std::min(a.norm(), std::sqrt(third * v.norm()));
  return std::max(dt * third, std::min(over_radian, longest * third));
}

/// Of all nodes, the largest.  @param per_correction  x''' over the correction of x0 + dt v0 + dt^2/2 a0 [1/s^3]
double largest_jerk(const partition::LocalNetwork& network, const StepStart& start, std::span<const double> growth,
                    double dt, double longest, double per_correction, Vec x1) {
  const petsc::ReadValues end(x1), x(start.x), v(start.v), a(start.a);
  double largest = 0;
  for (LocalNode node(0); network.is_owned(node); ++node) {
    const auto of_node = [begin = network.begin[node].value()](const double* values) {
      return Eigen::Map<const Vector3>(values + begin);
    };
    Vector3 correction = of_node(end) - of_node(x) - dt * of_node(v) - dt * dt / 2 * of_node(a);
    Vector3 smooth = of_node(a);
    if (!growth.empty()) {
      correction += dt * dt / 2 * of_node(growth.data());
      smooth -= 0.5 * of_node(growth.data());
    }
    largest = std::max(largest, weighed_jerk(dt, longest, of_node(v), smooth, per_correction * correction));
  }
  MPI_Comm communicator = MPI_COMM_NULL;
  check(PetscObjectGetComm(reinterpret_cast<PetscObject>(x1), &communicator));
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, communicator);
  return largest;
}

}   // namespace

/// a1 - a0 = (x1 - x0 - dt v0 - dt^2/2 a0) / (beta dt^2).  Where means are kept, 1/2 takes the place of beta.
double LocalError::estimate(const AlphaStep& step, const partition::LocalNetwork& network, const StepStart& start,
                            std::span<const double> growth, Vec x1) const {
  const double between = step.dt + acceleration_time(step, a_time_) - a_time_;
  const double constant = std::abs(step.beta + (step.alpha_f - step.alpha_m) / 2 - 1.0 / 6);
  const double beta = step.is_centred() ? 0.5 : step.beta;
  const double span = growth.empty() ? between : between + grown_over_;
  const double dt2 = step.dt * step.dt;
  return constant * dt2 * largest_jerk(network, start, growth, step.dt, longest_, 1 / (beta * dt2 * span), x1);
}

void LocalError::accept(const AlphaStep& step) {
  const double next = acceleration_time(step, a_time_);
  grown_over_ = step.dt + next - a_time_;
  a_time_ = next;
}

void LocalError::archive(Archive& archive) {
  archive.item("local_error.a_time", a_time_);
  archive.item("local_error.grown_over", grown_over_);
}

}   // namespace cablenet::solve
