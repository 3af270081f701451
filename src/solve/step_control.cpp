#include "cablenet/solve/step_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cablenet::solve {
namespace {

constexpr double rounding = 1e-6;   // of a step

/// A step is doubled if its error can then be expected to be at most this part of the tolerance.
constexpr double safety = 0.7;

/// So many steps in a row could have been doubled before one is.  If a step grew at once, it might have to shrink at
/// once.
constexpr int steps_before_growth = 3;

}   // namespace

StepControl::StepControl(double tolerance, double first, double longest, double shortest, int order)
    : tolerance_(tolerance), limit_(std::min(first, longest)), longest_(longest), shortest_(shortest), order_(order) {}

bool StepControl::accepts(double error, double dt) {
  error_ = error;
  dt_ = dt;
  if (error_ <= tolerance_ || dt_ < shortest_) return true;
  refused_error_ = error_;
  refused_dt_ = dt_;
  return false;
}

void StepControl::advance(bool retried) {
  const double wanted = std::min(2 * limit_, longest_), growth = wanted / dt_;
  const bool grows = !retried && wanted > limit_ && error_ * std::pow(growth, order_) <= safety * tolerance_;
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

void StepControl::archive(Archive& archive) {
  archive.item("step_control.limit", limit_);
  archive.item("step_control.error", error_);
  archive.item("step_control.dt", dt_);
  archive.item("step_control.refused_error", refused_error_);
  archive.item("step_control.refused_dt", refused_dt_);
  archive.item("step_control.growing", growing_);
}

}   // namespace cablenet::solve
