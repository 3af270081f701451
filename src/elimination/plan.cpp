#include "cablenet/elimination/plan.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

namespace cablenet::elimination {
namespace {

/// The number of multiplications in a product of two 3x3 blocks.
constexpr double products_in_block = 27;

/// Lays the plan down.  It finds later neighbours along the elimination tree: a block passes its later neighbours on to
/// the first of them.
class Planner {
public:
  Planner(const BlockGraph& graph, bool symmetric) : graph_(graph) {
    plan_.size = graph.size;
    plan_.uniform = std::all_of(graph.size.begin(), graph.size.end(), [](int size) { return size == 3; });
    plan_.symmetric = symmetric && plan_.uniform;
    if (std::any_of(graph.size.begin(), graph.size.end(), [](int size) { return size < 1 || size > largest_block; }))
      throw std::invalid_argument("a block of unknowns is empty or too large to be eliminated");
  }

  std::optional<Plan> make(double most_updates) {
    if (!find_later_neighbours(most_updates)) return std::nullopt;
    lay_out_values();
    for (int k = 0; k < graph_.eliminated; ++k) lay_out_updates(k);
    return std::move(plan_);
  }

private:
  bool find_later_neighbours(double most_updates);
  void collect(int k, std::vector<int>& found);
  void lay_out_values();
  void lay_out_updates(int k);
  /// Where a block's values begin, and its number in the order of factoring; -1 if its row and column are both kept.
  struct Found {
    std::int64_t offset, number;
  };
  Found find(int row, int column);
  std::int64_t number(int k, int coupling) const { return k + std::int64_t{plan_.symmetric ? 1 : 2} * coupling; }
  std::int64_t kept_offset(int row, int column);

  const BlockGraph& graph_;
  Plan plan_;
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
  for (int i = graph_.first[at(k)]; i < graph_.first[at(k) + 1]; ++i) add(graph_.adjacent[at(i)]);
  for (int child = first_child_[at(k)]; child >= 0; child = next_sibling_[at(child)])
    for (int i = plan_.first_later[at(child)]; i < plan_.first_later[at(child) + 1]; ++i) add(plan_.later[at(i)]);
  std::sort(found.begin(), found.end());
}

bool Planner::find_later_neighbours(double most_updates) {
  const std::size_t count = at(graph_.eliminated);
  first_child_.assign(count, -1);
  next_sibling_.assign(count, -1);
  seen_by_.assign(graph_.size.size(), -1);
  plan_.first_later.assign(1, 0);
  plan_.first_later.reserve(count + 1);
  plan_.later.reserve(count);
  std::vector<int> found;
  double products = 0;
  for (int k = 0; k < graph_.eliminated; ++k) {
    collect(k, found);
    plan_.later.insert(plan_.later.end(), found.begin(), found.end());
    plan_.first_later.push_back(static_cast<int>(plan_.later.size()));
    int unknowns = 0;
    for (const int j : found) unknowns += plan_.size[at(j)];
    const double m = unknowns;
    products += plan_.size[at(k)] * (plan_.symmetric ? m * (m + 3) / 2 : m * m);
    if (products > most_updates * products_in_block) return false;
    if (found.empty() || found.front() >= graph_.eliminated) continue;
    next_sibling_[at(k)] = first_child_[at(found.front())];
    first_child_[at(found.front())] = k;
  }
  plan_.updates = products / products_in_block;
  return true;
}

void Planner::lay_out_values() {
  const std::int64_t blocks = graph_.eliminated, couplings = static_cast<std::int64_t>(plan_.later.size());
  std::int64_t pivots = 9 * blocks, one_side = 9 * couplings;
  if (!plan_.uniform) {
    pivots = one_side = 0;
    for (int k = 0; k < graph_.eliminated; ++k) {
      plan_.mixed_pivots.push_back(pivots);
      pivots += plan_.size[at(k)] * plan_.size[at(k)];
      for (int i = plan_.first_later[at(k)]; i < plan_.first_later[at(k) + 1]; ++i) {
        plan_.mixed_couplings.push_back(one_side);
        one_side += plan_.size[at(k)] * plan_.size[at(plan_.later[at(i)])];
      }
    }
    plan_.mixed_pivots.push_back(pivots);
    plan_.mixed_couplings.push_back(one_side);
  }
  plan_.upper_values = pivots;
  plan_.lower_values = pivots + (plan_.symmetric ? 0 : one_side);
  plan_.kept_values = plan_.values = plan_.lower_values + one_side;
  plan_.touched.assign(at(number(graph_.eliminated, static_cast<int>(couplings))), false);
}

std::int64_t Planner::kept_offset(int row, int column) {
  const auto [found, is_new] = kept_.try_emplace({row, column}, plan_.values);
  if (is_new) {
    plan_.kept.push_back({row, column, plan_.values});
    plan_.values += plan_.size[at(row)] * plan_.size[at(column)];
  }
  return found->second;
}

Planner::Found Planner::find(int row, int column) {
  const int owner = std::min(row, column);
  if (owner >= graph_.eliminated) return {kept_offset(row, column), -1};
  if (row == column) return {plan_.pivot(row), number(row, plan_.first_later[at(row)])};
  const auto begin = plan_.later.begin() + plan_.first_later[at(owner)];
  const auto end = plan_.later.begin() + plan_.first_later[at(owner) + 1];
  const int i = static_cast<int>(std::lower_bound(begin, end, std::max(row, column)) - plan_.later.begin());
  const std::int64_t first = number(owner, i) + 1;
  if (row < column) return {plan_.upper_values + plan_.coupling(i), first};
  return {plan_.lower_values + plan_.coupling(i), plan_.symmetric ? first : first + 1};
}

void Planner::lay_out_updates(int k) {
  const auto begin = plan_.later.begin() + plan_.first_later[at(k)];
  const auto end = plan_.later.begin() + plan_.first_later[at(k) + 1];
  for (auto i = begin; i != end; ++i)
    for (auto j = begin; j != (plan_.symmetric ? i + 1 : end); ++j) {
      const auto [offset, number] = find(*i, *j);
      const bool first = number >= 0 && !plan_.touched[at(number)];
      if (first) plan_.touched[at(number)] = true;
      plan_.targets.push_back(first ? ~offset : offset);
    }
}

}   // namespace

std::optional<Plan> make_plan(const BlockGraph& graph, bool symmetric, double most_updates) {
  return Planner(graph, symmetric).make(most_updates);
}

}   // namespace cablenet::elimination
