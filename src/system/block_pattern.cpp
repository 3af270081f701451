#include "block_pattern.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

Slot BlockPattern::block(LocalNode row_node, LocalNode column_node) {
  const LocalNode row = network_.anchor(row_node), column = network_.anchor(column_node);
  if (!network_.is_owned(row) || !network_.is_free(column)) return {};
  const bool other = !network_.is_owned(column);
  const SolverNumber number = network_.number(column);
  if (!is_fixed_) {
    if (row != column) noted_.push_back({other, row, number});
    return {};
  }
  Rows& rows = rows_[other ? 1 : 0];
  Slot slot;
  int width = 0;
  for (std::size_t i = at(rows.first[at(row)]); i < at(rows.first[at(row) + 1]); ++i) {
    if (rows.column[i] == number) {
      slot.offset = rows.begin[at(row)] + width;
      slot.add = rows.written[i];
      rows.written[i] = true;
    }
    width += size(rows.column[i]);
  }
  slot.stride = static_cast<unsigned>(width) & 0x1fffffff;
  slot.other = other;
  slot.absent = 0;
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

/// Every owned node has a block with itself.
void BlockPattern::fix(MPI_Comm communicator) {
  check_size(estimated_values(network_), communicator);
  for (LocalNode node(0); network_.is_owned(node); ++node) noted_.push_back({false, node, network_.number(node)});
  std::sort(noted_.begin(), noted_.end());
  noted_.erase(std::unique(noted_.begin(), noted_.end()), noted_.end());
  auto pair = noted_.begin();
  for (Rows& rows : rows_) {
    const bool other = &rows == &rows_[1];
    for (LocalNode row(0); network_.is_owned(row); ++row) {
      int width = 0;
      for (; pair != noted_.end() && pair->other == other && pair->row == row; ++pair) {
        rows.column.push_back(pair->column);
        width += size(pair->column);
      }
      rows.first.push_back(static_cast<int>(rows.column.size()));
      rows.begin.push_back(rows.begin.back() + width * size(network_.number(row)));
    }
    rows.written.resize(rows.column.size());
  }
  noted_ = {};
  is_fixed_ = true;
  // A body clears its own block.
  for (int b = 0; b < network_.own_bodies; ++b) block(network_.bodies[at(b)].node, network_.bodies[at(b)].node);
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
          const SolverNumber column = rows.column[at(i)];
          for (int c = 0; c < size(column); ++c) columns.push_back(network_.blocks.begin(column) + c);
        }
      std::sort(columns.begin() + begin, columns.end());
      first.push_back(static_cast<PetscInt>(columns.size()));
    }
  check(MatSeqAIJSetPreallocationCSR(matrix, first.data(), columns.data(), nullptr));
  check(MatMPIAIJSetPreallocationCSR(matrix, first.data(), columns.data(), nullptr));
}

}   // namespace cablenet::system
