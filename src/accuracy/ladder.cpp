#include "cablenet/accuracy/ladder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cablenet::accuracy {

/// Runs that differ by more are not near enough to each other to show an order.
constexpr double too_far = 0.3;
constexpr double least_order = 1, most_order = 2;

void Ladder::add(double size, Trial trial) {
  before_ = count() > 1 ? difference_ : std::numeric_limits<double>::infinity();
  rungs_.push_back({size, std::move(trial)});
  estimate();
}

double Ladder::error() const {
  return errors_.empty() ? std::numeric_limits<double>::infinity() : *std::max_element(errors_.begin(), errors_.end());
}

bool Ladder::is_stuck() const { return count() > 2 && difference_ > 0.6 * before_; }

void Ladder::estimate() {
  const std::size_t n = count();
  errors_.clear();
  if (n < 2) return;
  const Rung &fine = rungs_[n - 1], &coarse = rungs_[n - 2];
  const double ratio = coarse.size / fine.size;
  errors_ = differences(coarse.trial.history, fine.trial.history);
  difference_ = *std::max_element(errors_.begin(), errors_.end());
  std::vector<double> first(errors_.size(), 0);
  if (n > 2) first = differences(rungs_[n - 3].trial.history, coarse.trial.history);
  for (std::size_t c = 0; c < errors_.size(); ++c) {
    double order = most_order;
    if (first[c] > 0 && errors_[c] > 0 && first[c] < too_far)
      order = (most_order + std::clamp(std::log(first[c] / errors_[c]) / std::log(ratio), least_order, most_order)) / 2;
    errors_[c] /= std::pow(ratio, order) - 1;
  }
}

HistoryTable Ladder::limit() const {
  const Rung &fine = rungs_[count() - 1], &coarse = rungs_[count() - 2];
  const double gain = 1 / (std::pow(coarse.size / fine.size, most_order) - 1);
  HistoryTable result = fine.trial.history;
  if (coarse.trial.history.rows.size() != result.rows.size()) return result;
  for (std::size_t i = 0; i < result.rows.size(); ++i)
    for (std::size_t c = 1; c < result.rows[i].size(); ++c)
      result.rows[i][c] += gain * (result.rows[i][c] - coarse.trial.history.rows[i][c]);
  return result;
}

}   // namespace cablenet::accuracy
