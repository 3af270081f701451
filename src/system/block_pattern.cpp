#include "block_pattern.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "cablenet/base/errors.hpp"
#include "cablenet/petsc/handle.hpp"

namespace cablenet::system {

using petsc::check;

namespace {

/// @throws InputError on every rank alike where a rank's matrix would be longer than 32 bits can count.
void check_size(double values, MPI_Comm communicator) {
  constexpr double most = std::numeric_limits<int>::max();
  int ranks = 1;
  MPI_Comm_size(communicator, &ranks);
  MPI_Allreduce(MPI_IN_PLACE, &values, 1, MPI_DOUBLE, MPI_MAX, communicator);
  if (values > most)
    throw InputError(
        fmt::format("the network is too large for {} rank{}: the matrix would have up to {:.2g} values on one, "
                    "and 32 bits count to {:.2g}; use at least {} ranks",
                    ranks, ranks == 1 ? "" : "s", values, most, std::ceil(1.1 * ranks * values / most)));
}

/// An element has four blocks of 9 values, a node at most one more; at a body's attachments they are larger.
double estimated_values(const partition::LocalNetwork& network) {
  return 9.0 * (2.0 * static_cast<double>(network.elements.size()) + network.owned) +
         50.0 * static_cast<double>(network.carried.size() + network.bodies.size());
}

}   // namespace

int BlockPattern::Rows::find(LocalNode row, SolverNumber wanted) const {
  const auto begin = column.begin() + first[at(row)], end = column.begin() + first[at(row) + 1];
  return static_cast<int>(std::lower_bound(begin, end, wanted.value()) - column.begin());
}

int BlockPattern::Rows::row_values(LocalNode row) const {
  return values.empty() ? 9 * first[at(row)] : values[at(row)];
}

int BlockPattern::Rows::column_values(LocalNode row, int block) const {
  return values.empty() ? 3 * (block - first[at(row)]) : offset[at(block)];
}

int BlockPattern::Rows::width(LocalNode row, int size) const {
  return values.empty() ? 3 * (first[at(row) + 1] - first[at(row)]) : (values[at(row) + 1] - values[at(row)]) / size;
}

BlockPattern::BlockPattern(const partition::LocalNetwork& network) : network_(network) {}

Slot BlockPattern::block(LocalNode row_node, LocalNode column_node) {
  const LocalNode row = network_.anchor(row_node), column = network_.anchor(column_node);
  if (!network_.is_owned(row) || !network_.is_free(column)) return {};
  const bool other = !network_.is_owned(column);
  const SolverNumber number = network_.number(column);
  if (!is_fixed_) {
    if (row != column) noted_.push_back({row, number, other});
    return {};
  }
  Rows& rows = rows_[other ? 1 : 0];
  const int block = rows.find(row, number);
  Slot slot;
  slot.offset = rows.row_values(row) + rows.column_values(row, block);
  slot.stride = static_cast<unsigned>(rows.width(row, size(network_.number(row)))) & 0x1fffffff;
  slot.other = other;
  slot.absent = 0;
  slot.add = rows.written[at(block)];
  rows.written[at(block)] = true;
  return slot;
}

PairSlots BlockPattern::pair(const std::array<LocalNode, 2>& node) {
  const auto [a, b] = node;
  const bool same_body = network_.anchor(a) == network_.anchor(b);
  PairSlots slots;
  if (!network_.is_carried(a)) slots[0] = block(a, a);
  if (!same_body) slots[1] = block(a, b);
  if (!same_body) slots[2] = block(b, a);
  if (!network_.is_carried(b)) slots[3] = block(b, b);
  return slots;
}

void BlockPattern::add_elements() {
  elements_.resize(network_.elements.size());
  for (std::size_t i = 0; i < elements_.size(); ++i) elements_[i] = pair(network_.elements[i].node);
}

void BlockPattern::fix(MPI_Comm communicator) {
  check_size(estimated_values(network_), communicator);
  for (const bool other : {false, true}) {
    Rows& rows = rows_[other ? 1 : 0];
    rows = compress(other);
    rows.written.assign(rows.column.size(), false);
    if (!network_.blocks.uniform()) measure(rows);
  }
  noted_ = {};
  is_fixed_ = true;
  for (int b = 0; b < network_.own_bodies; ++b) {
    const LocalNode node = network_.bodies[at(b)].node;
    rows_[0].written[at(rows_[0].find(node, network_.number(node)))] = true;
  }
}

/// Every owned node has a block with itself.
BlockPattern::Rows BlockPattern::compress(bool other) const {
  const auto for_each = [&](const auto& visit) {
    for (LocalNode node(0); !other && node.value() < network_.owned; ++node) visit(node, network_.number(node));
    for (const Pair& pair : noted_)
      if (pair.other == other) visit(pair.row, pair.column);
  };
  std::vector<int> next(at(network_.owned) + 1, 0);
  for_each([&](LocalNode row, SolverNumber) { ++next[at(row) + 1]; });
  std::partial_sum(next.begin(), next.end(), next.begin());
  const std::vector<int> first = next;
  Rows rows;
  rows.column.resize(at(next.back()));
  for_each([&](LocalNode row, SolverNumber column) { rows.column[at(next[at(row)]++)] = column.value(); });
  rows.first.push_back(0);
  auto to = rows.column.begin();
  for (int row = 0; row < network_.owned; ++row) {
    const auto begin = rows.column.begin() + first[at(row)], end = rows.column.begin() + first[at(row) + 1];
    std::sort(begin, end);
    to = std::copy(begin, std::unique(begin, end), to);
    rows.first.push_back(static_cast<int>(to - rows.column.begin()));
  }
  rows.column.resize(at(rows.first.back()));
  return rows;
}

void BlockPattern::measure(Rows& rows) const {
  rows.values.push_back(0);
  for (LocalNode row(0); row.value() < network_.owned; ++row) {
    int width = 0;
    for (int i = rows.first[at(row)]; i < rows.first[at(row) + 1]; ++i) {
      rows.offset.push_back(width);
      width += size(SolverNumber(rows.column[at(i)]));
    }
    rows.values.push_back(rows.values.back() + width * size(network_.number(row)));
  }
}

void BlockPattern::preallocate(Mat matrix) const {
  std::vector<PetscInt> first{0}, columns;
  first.reserve(at(network_.unknowns()) + 1);
  columns.reserve(9 * (rows_[0].column.size() + rows_[1].column.size()));
  for (LocalNode row(0); row.value() < network_.owned; ++row)
    for (int r = 0; r < size(network_.number(row)); ++r) {
      const auto begin = static_cast<std::ptrdiff_t>(columns.size());
      for (const Rows& rows : rows_)
        for (int i = rows.first[at(row)]; i < rows.first[at(row) + 1]; ++i) {
          const SolverNumber column(rows.column[at(i)]);
          for (int c = 0; c < size(column); ++c) columns.push_back(network_.blocks.begin(column) + c);
        }
      std::sort(columns.begin() + begin, columns.end());
      first.push_back(static_cast<PetscInt>(columns.size()));
    }
  check(MatSeqAIJSetPreallocationCSR(matrix, first.data(), columns.data(), nullptr));
  check(MatMPIAIJSetPreallocationCSR(matrix, first.data(), columns.data(), nullptr));
}

}   // namespace cablenet::system
