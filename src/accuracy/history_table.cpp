#include "cablenet/accuracy/history_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace cablenet::accuracy {
namespace {

/// A component that moves less than this share of its vector's largest one is scaled by the share.
constexpr double least_component = 0.1;
/// What hardly changes is scaled by this share of its size: its range would be rounding's.
constexpr double least_change = 1e-3;
/// A range below this share of the size is rounding's.
constexpr double least_range = 1e-12;

enum class Kind { none, position, velocity, force, attitude, spin, energy, other };

struct Ending {
  const char* text;
  Kind kind;
};
constexpr std::array endings{
    Ending{"x", Kind::position},  Ending{"y", Kind::position},  Ending{"z", Kind::position},
    Ending{"vx", Kind::velocity}, Ending{"vy", Kind::velocity}, Ending{"vz", Kind::velocity},
    Ending{"ax", Kind::none},     Ending{"ay", Kind::none},     Ending{"az", Kind::none},
    Ending{"fx", Kind::force},    Ending{"fy", Kind::force},    Ending{"fz", Kind::force},
    Ending{"qw", Kind::attitude}, Ending{"qx", Kind::attitude}, Ending{"qy", Kind::attitude},
    Ending{"qz", Kind::attitude}, Ending{"wx", Kind::spin},     Ending{"wy", Kind::spin},
    Ending{"wz", Kind::spin},
};

struct Column {
  std::string owner;
  Kind kind;
};

Column column_of(const std::string& name) {
  const auto dot = name.rfind('.');
  if (dot == std::string::npos) return {name, Kind::none};
  const std::string owner = name.substr(0, dot), ending = name.substr(dot + 1);
  if (owner == "energy") return {owner, Kind::energy};
  for (const Ending& known : endings)
    if (ending == known.text) return {owner, known.kind};
  return {name, Kind::other};
}

/// What share of the largest range of its vector a component is scaled by at least.
double share_of(Kind kind) {
  return kind == Kind::force || kind == Kind::energy || kind == Kind::other ? 1 : least_component;
}

/// The largest size of a column, and how far it ranges.
struct Extremes {
  double least = 0, most = 0;
  double size() const { return std::max(std::abs(least), std::abs(most)); }
  double range() const { return most - least; }
};

std::vector<Extremes> extremes_of(const HistoryTable& table) {
  std::vector<Extremes> all(table.columns.size());
  for (std::size_t c = 0; c < all.size(); ++c) {
    if (!table.rows.empty()) all[c] = {table.rows.front()[c], table.rows.front()[c]};
    for (const auto& row : table.rows) all[c] = {std::min(all[c].least, row[c]), std::max(all[c].most, row[c])};
  }
  return all;
}

/// Those of an equilibrium.
std::vector<double> static_ranges(const std::vector<Column>& columns, const HistoryTable& table,
                                  const std::vector<Extremes>& extremes) {
  std::map<char, Extremes> places;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (columns[c].kind != Kind::position) continue;
    const double at = extremes[c].least;
    const auto [place, is_new] = places.try_emplace(table.columns[c].back(), Extremes{at, at});
    place->second = {std::min(place->second.least, at), std::max(place->second.most, at)};
  }
  double extent = 0;
  for (const auto& [axis, of] : places) extent = std::max(extent, of.range());
  std::vector<double> ranges(columns.size());
  for (std::size_t c = 0; c < columns.size(); ++c)
    ranges[c] = columns[c].kind == Kind::position ? extent : extremes[c].size();
  return ranges;
}

/// The row at a time, which lies between two rows.
std::vector<double> row_at(const HistoryTable& table, double t, std::size_t& next) {
  while (next + 1 < table.rows.size() && table.rows[next].front() < t) ++next;
  if (next == 0) return table.rows.front();
  const auto &a = table.rows[next - 1], &b = table.rows[next];
  const double span = b.front() - a.front();
  const double part = span > 0 ? std::clamp((t - a.front()) / span, 0.0, 1.0) : 1;
  if (part > 1 - 1e-9) return b;
  std::vector<double> row(a.size());
  for (std::size_t c = 0; c < row.size(); ++c) row[c] = a[c] + part * (b[c] - a[c]);
  return row;
}

}   // namespace

std::vector<double> scales(const HistoryTable& table) {
  std::vector<Column> columns;
  for (const std::string& name : table.columns) columns.push_back(column_of(name));
  const std::vector<Extremes> extremes = extremes_of(table);
  std::vector<double> ranges(columns.size());
  for (std::size_t c = 0; c < ranges.size(); ++c) ranges[c] = extremes[c].range();
  if (table.rows.size() == 1) ranges = static_ranges(columns, table, extremes);
  std::map<std::pair<std::string, Kind>, std::pair<double, double>> groups;   // the largest range and size
  for (std::size_t c = 0; c < columns.size(); ++c) {
    auto& [range, size] = groups[{columns[c].owner, columns[c].kind}];
    range = std::max(range, ranges[c]);
    size = std::max(size, extremes[c].size());
  }
  std::vector<double> result(columns.size(), 0);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const Kind kind = columns[c].kind;
    if (kind == Kind::none) continue;
    auto [largest, size] = groups[{columns[c].owner, kind}];
    if (kind != Kind::position && kind != Kind::attitude) largest = std::max(largest, least_change * size);
    const double scale = std::max(ranges[c], share_of(kind) * largest);
    result[c] = scale > least_range * extremes[c].size() ? scale : 0;
  }
  return result;
}

std::vector<double> errors_at_first(const HistoryTable& run, const HistoryTable& finer) {
  const std::vector<double> scale = scales(run);
  std::vector<double> sums(scale.size(), 0);
  std::size_t next = 0;
  for (const auto& row : run.rows) {
    if (row.front() > finer.rows.back().front()) break;
    const std::vector<double> other = row_at(finer, row.front(), next);
    for (std::size_t c = 0; c < sums.size(); ++c)
      if (scale[c] > 0) sums[c] += std::pow((row[c] - other[c]) / scale[c], 2);
  }
  constexpr double whole = 4.0 / 3;
  for (double& sum : sums) sum = whole * std::sqrt(sum / static_cast<double>(run.rows.size()));
  return sums;
}

Estimate largest(const std::vector<double>& errors, const HistoryTable& table) {
  const auto worst = std::max_element(errors.begin(), errors.end());
  if (worst == errors.end() || *worst == 0) return {std::numeric_limits<double>::infinity(), ""};
  return {*worst, table.columns[static_cast<std::size_t>(worst - errors.begin())]};
}

std::vector<double> differences(const HistoryTable& coarse, const HistoryTable& fine) {
  const std::vector<double> scale = scales(fine);
  std::vector<double> sums(scale.size(), 0);
  std::size_t next = 0;
  for (const auto& row : fine.rows) {
    const std::vector<double> other = row_at(coarse, row.front(), next);
    for (std::size_t c = 0; c < sums.size(); ++c)
      if (scale[c] > 0) sums[c] += std::pow((row[c] - other[c]) / scale[c], 2);
  }
  for (double& sum : sums) sum = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(fine.rows.size(), 1)));
  return sums;
}

}   // namespace cablenet::accuracy
