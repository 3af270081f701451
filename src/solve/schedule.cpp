#include "cablenet/solve/schedule.hpp"

#include <algorithm>
#include <cmath>

namespace cablenet::solve {
namespace {

/// Times that differ by less than this part of a step are equal: their rounding adds up to less.
constexpr double rounding = 1e-9;

/// So many steps are good before steps grow again.  If they grew at once, the next would fail at once.
constexpr int steps_before_growth = 4;

}   // namespace

Schedule::Schedule(double start, double end, double step, double interval)
    : start_(start), end_(end), step_(step), interval_(interval), t_(start), limit_(step) {
  plan();
}

double Schedule::goal() const {
  if (interval_ <= 0) return end_;
  const double next = start_ + interval_ * static_cast<double>(outputs_ + 1);
  return next > end_ - rounding * step_ ? end_ : next;
}

void Schedule::plan() {
  const double span = goal() - t_;
  from_ = t_;
  done_ = 0;
  total_ = std::max(1L, static_cast<long>(std::ceil(span / limit_ * (1 - rounding))));
  h_ = span / static_cast<double>(total_);
}

void Schedule::advance(double taken, bool retried) {
  const bool as_planned = std::abs(taken - h_) <= rounding * h_;
  if (as_planned) ++done_;
  t_ = as_planned ? from_ + static_cast<double>(done_) * h_ : t_ + taken;
  const bool reached = done_ == total_ || goal() - t_ <= rounding * step_;
  if (reached) t_ = goal();
  at_output_ = reached || interval_ <= 0;
  if (reached) ++outputs_;
  const double old_limit = limit_;
  good_ = retried ? 0 : good_ + 1;
  if (retried) limit_ = std::min(limit_, taken);
  if (grows_ && limit_ < step_ && good_ >= steps_before_growth) {
    limit_ = std::min(step_, 2 * limit_);
    good_ = 0;
  }
  if (reached || !as_planned || limit_ != old_limit) plan();
}

void Schedule::set_limit(double wanted) {
  grows_ = false;
  if (wanted == limit_) return;
  limit_ = wanted;
  plan();
}

void Schedule::archive(Archive& archive) {
  archive.item("schedule.time", t_);
  archive.item("schedule.limit", limit_);
  archive.item("schedule.grows", grows_);
  archive.item("schedule.good", good_);
  archive.item("schedule.outputs", outputs_);
  archive.item("schedule.at_output", at_output_);
  archive.item("schedule.from", from_);
  archive.item("schedule.step", h_);
  archive.item("schedule.done", done_);
  archive.item("schedule.total", total_);
}

}   // namespace cablenet::solve
