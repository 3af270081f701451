#include "cablenet/elimination/schedule.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

namespace cablenet::elimination {
namespace {

std::size_t at(std::int64_t index) { return static_cast<std::size_t>(index); }

/// Lays the schedule down; later neighbours come from the elimination tree: a block hands its own to the first of them.
class Planner {
public:
  Planner(const Pattern& pattern, bool symmetric) : pattern_(pattern) {
    plan_.size = pattern.size;
    plan_.uniform = std::all_of(pattern.size.begin(), pattern.size.end(), [](int size) { return size == 3; });
    plan_.symmetric = symmetric && plan_.uniform;
    if (std::any_of(pattern.size.begin(), pattern.size.end(),
                    [](int size) { return size < 1 || size > largest_block; }))
      throw std::invalid_argument("a block of unknowns is empty or too large to be eliminated");
  }

  std::optional<Schedule> plan(double most_updates) {
    if (!find_later_neighbours(most_updates)) return std::nullopt;
    place_values();
    for (int k = 0; k < pattern_.eliminated; ++k) place_updates(k);
    plan_.nodes.back().first_target = static_cast<std::int64_t>(plan_.targets.size());
    return std::move(plan_);
  }

private:
  bool find_later_neighbours(double most_updates);
  void collect(int k, std::vector<int>& found);
  void place_values();
  void place_updates(int k);
  std::pair<std::int64_t, std::int64_t> find(int row, int column);
  std::int64_t kept_place(int row, int column);

  const Pattern& pattern_;
  Schedule plan_;
  std::vector<int> first_child_, next_sibling_, seen_by_;
  std::map<std::pair<int, int>, std::int64_t> kept_;
};

void Planner::collect(int k, std::vector<int>& found) {
  found.clear();
  const auto add = [&](int j) {
    if (j <= k || seen_by_[at(j)] == k) return;
    seen_by_[at(j)] = k;
    found.push_back(j);
  };
  for (int i = pattern_.first[at(k)]; i < pattern_.first[at(k) + 1]; ++i) add(pattern_.adjacent[at(i)]);
  for (int child = first_child_[at(k)]; child >= 0; child = next_sibling_[at(child)])
    for (int i = plan_.nodes[at(child)].first_later; i < plan_.nodes[at(child) + 1].first_later; ++i)
      add(plan_.later[at(i)]);
  std::sort(found.begin(), found.end());
}

bool Planner::find_later_neighbours(double most_updates) {
  const std::size_t count = at(pattern_.eliminated);
  first_child_.assign(count, -1);
  next_sibling_.assign(count, -1);
  seen_by_.assign(pattern_.size.size(), -1);
  plan_.nodes.resize(count + 1);
  plan_.later.reserve(count);
  std::vector<int> found;
  for (int k = 0; k < pattern_.eliminated; ++k) {
    plan_.nodes[at(k)].first_later = static_cast<int>(plan_.later.size());
    collect(k, found);
    plan_.later.insert(plan_.later.end(), found.begin(), found.end());
    plan_.nodes[at(k) + 1].first_later = static_cast<int>(plan_.later.size());
    const double m = static_cast<double>(found.size());
    plan_.updates += plan_.symmetric ? m * (m + 1) / 2 : m * m;
    if (plan_.updates > most_updates) return false;
    if (found.empty() || found.front() >= pattern_.eliminated) continue;
    next_sibling_[at(k)] = first_child_[at(found.front())];
    first_child_[at(found.front())] = k;
  }
  return true;
}

void Planner::place_values() {
  std::int64_t place = 0, block = 0;
  for (int k = 0; k < pattern_.eliminated; ++k) {
    Schedule::Node& node = plan_.nodes[at(k)];
    node.values = place;
    node.first_block = block;
    const int own = plan_.size[at(k)];
    place += own * own;
    for (int i = node.first_later; i < plan_.nodes[at(k) + 1].first_later; ++i)
      place += (plan_.symmetric ? 1 : 2) * own * plan_.size[at(plan_.later[at(i)])];
    block += 1 + (plan_.symmetric ? 1 : 2) * (plan_.nodes[at(k) + 1].first_later - node.first_later);
  }
  plan_.nodes.back().values = plan_.kept_values = plan_.values = place;
  plan_.nodes.back().first_block = block;
  plan_.touched.assign(at(block), false);
}

std::int64_t Planner::kept_place(int row, int column) {
  const auto [found, is_new] = kept_.try_emplace({row, column}, plan_.values);
  if (is_new) {
    plan_.kept.push_back({row, column, plan_.values});
    plan_.values += plan_.size[at(row)] * plan_.size[at(column)];
  }
  return found->second;
}

/// Where the block (row, column) stands, and its number among the eliminated ones' blocks; -1 if both are kept.
std::pair<std::int64_t, std::int64_t> Planner::find(int row, int column) {
  const int owner = std::min(row, column);
  if (owner >= pattern_.eliminated) return {kept_place(row, column), -1};
  const Schedule::Node& node = plan_.nodes[at(owner)];
  if (row == column) return {node.values, node.first_block};
  const int own = plan_.size[at(owner)];
  std::int64_t place = node.values + own * own;
  std::int64_t block = node.first_block + 1;
  const int sides = plan_.symmetric ? 1 : 2;
  for (int i = node.first_later;; ++i, block += sides) {
    const int j = plan_.later[at(i)];
    const int area = own * plan_.size[at(j)];
    if (j == std::max(row, column))
      return plan_.symmetric || row < column ? std::pair(place, block) : std::pair(place + area, block + 1);
    place += sides * area;
  }
}

void Planner::place_updates(int k) {
  plan_.nodes[at(k)].first_target = static_cast<std::int64_t>(plan_.targets.size());
  const auto begin = plan_.later.begin() + plan_.nodes[at(k)].first_later;
  const auto end = plan_.later.begin() + plan_.nodes[at(k) + 1].first_later;
  for (auto i = begin; i != end; ++i)
    for (auto j = begin; j != (plan_.symmetric ? i + 1 : end); ++j) {
      const auto [place, block] = find(*i, *j);
      const bool first = block >= 0 && !plan_.touched[at(block)];
      if (first) plan_.touched[at(block)] = true;
      plan_.targets.push_back(first ? ~place : place);
    }
}

}   // namespace

std::optional<Schedule> make_schedule(const Pattern& pattern, bool symmetric, double most_updates) {
  return Planner(pattern, symmetric).plan(most_updates);
}

}   // namespace cablenet::elimination
