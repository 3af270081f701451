#include "cablenet/solve/step_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cablenet::solve {
namespace {

constexpr double rounding = 1e-6;   // of a step

/// A step that errs by next to nothing, as after a failure of Newton's method, grows by so much at once.
constexpr double largest_growth = 4;

/// Into so many parts the longest step is divided at most.
constexpr double most_parts = 8;

/// A step grows if its error can then be expected to be at most this part of the tolerance.
constexpr double safety = 0.7;

/// So many steps in a row could have grown before one does.  If a step grew at once, it might have to shrink at once.
constexpr int steps_before_growth = 2;

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

/// The longest step of at most `most` that goes 1, 2, 4 or 8 times into the longest one.  Such steps land on the output
/// times without being cut.  Shorter ones lose little by a cut.
double StepControl::fitting(double most) const {
  if (most >= longest_) return longest_;
  const double parts = std::exp2(std::ceil(std::log2(longest_ / most) - rounding));
  return parts <= most_parts ? longest_ / parts : most;
}

/// The limit that the error of the last step allows.
double StepControl::longer() const {
  for (const double growth : {largest_growth, 2.0}) {
    const double wanted = fitting(growth * limit_);
    if (error_ * std::pow(wanted / dt_, order_) <= safety * tolerance_) return std::max(wanted, limit_);
  }
  return limit_;
}

void StepControl::advance(bool retried) {
  const double wanted = retried ? limit_ : longer();
  growing_ = wanted > limit_ ? growing_ + 1 : 0;
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
