#include "cablenet/solve/mean_acceleration.hpp"

#include <algorithm>

#include "cablenet/petsc/values.hpp"

namespace cablenet::solve {
namespace {

/// The lesser of two changes, or none where they differ in sign: the middle one of the two and 0.
double lesser(double one, double other) { return std::clamp(0.0, std::min(one, other), std::max(one, other)); }

}   // namespace

void MeanAcceleration::advance(double dt, Vec v0, Vec v1, Vec a, Vec expected) {
  PetscInt size = 0;
  petsc::check(VecGetLocalSize(a, &size));
  const petsc::ReadValues start(v0), end(v1);
  const petsc::ChangedValues mean(a);
  const petsc::WrittenValues next(expected);
  const auto count = static_cast<std::size_t>(size);
  growth_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double now = (end[i] - start[i]) / dt, growth = now - mean[i];
    mean[i] = now;
    next[i] = now + lesser(growth, growth_[i]);
    growth_[i] = growth;
  }
}

}   // namespace cablenet::solve
