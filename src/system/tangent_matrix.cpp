#include "cablenet/system/tangent_matrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "cablenet/base/errors.hpp"
#include "cablenet/petsc/object_state.hpp"

namespace cablenet::system {
namespace {

using petsc::check;

/// Block columns of each owned node's row, ascending, in compressed rows.
struct BlockRows {
  std::vector<int> first;
  std::vector<SolverNumber> column;
  /// Where sizes differ: per row and one past, its first value; per block, its first column in the row's values.
  std::vector<int> values, offset;

  /// The block's index among all.
  int block(LocalNode node, SolverNumber wanted) const {
    const std::size_t row = at(node);
    const auto found = std::lower_bound(column.begin() + first[row], column.begin() + first[row + 1], wanted);
    return static_cast<int>(found - column.begin());
  }
  int row_values(int row) const { return values.empty() ? 9 * first[at(row)] : values[at(row)]; }
  int column_values(int row, int block) const {
    return values.empty() ? 3 * (block - first[at(row)]) : offset[at(block)];
  }
  int width(int row, int size) const {
    return values.empty() ? 3 * (first[at(row) + 1] - first[at(row)]) : (values[at(row) + 1] - values[at(row)]) / size;
  }
  void place(const partition::Blocks& blocks, SolverNumber first_number);
};

void BlockRows::place(const partition::Blocks& blocks, SolverNumber first_number) {
  if (blocks.uniform()) return;
  values.push_back(0);
  for (int row = 0; row + 1 < static_cast<int>(first.size()); ++row) {
    int width = 0;
    for (int i = first[at(row)]; i < first[at(row) + 1]; ++i) {
      offset.push_back(width);
      width += blocks.size(column[at(i)]);
    }
    values.push_back(values.back() + width * blocks.size(first_number + row));
  }
}

/// @param each  calls its argument with every (row, column), repetitions included
template <class Each>
BlockRows block_rows(int rows, const Each& each) {
  BlockRows result;
  std::vector<int> next(at(rows) + 1, 0);
  each([&](LocalNode row, SolverNumber) { ++next[at(row) + 1]; });
  std::partial_sum(next.begin(), next.end(), next.begin());
  const std::vector<int> first = next;
  result.column.resize(at(next.back()));
  each([&](LocalNode row, SolverNumber column) { result.column[at(next[at(row)]++)] = column; });
  result.first.push_back(0);
  auto to = result.column.begin();
  for (int row = 0; row < rows; ++row) {
    const auto begin = result.column.begin() + first[at(row)], end = result.column.begin() + first[at(row) + 1];
    std::sort(begin, end);
    to = std::copy(begin, std::unique(begin, end), to);
    result.first.push_back(static_cast<int>(to - result.column.begin()));
  }
  result.column.resize(at(result.first.back()));
  return result;
}

/// An element has four blocks of 9 values, a node at most one more; at a body's attachments they are larger.
/// @throws InputError on every rank alike where a rank's matrix would be longer than 32 bits can count.
void check_size(const partition::LocalNetwork& network, MPI_Comm communicator) {
  constexpr double most = std::numeric_limits<int>::max();
  double values = 9.0 * (2.0 * static_cast<double>(network.elements.size()) + network.owned) +
                  50.0 * static_cast<double>(network.carried.size() + network.bodies.size());
  int ranks = 1;
  MPI_Comm_size(communicator, &ranks);
  MPI_Allreduce(MPI_IN_PLACE, &values, 1, MPI_DOUBLE, MPI_MAX, communicator);
  if (values > most)
    throw InputError(
        fmt::format("the network is too large for {} rank{}: the matrix would have up to {:.2g} values on one, "
                    "and 32 bits count to {:.2g}; use at least {} ranks",
                    ranks, ranks == 1 ? "" : "s", values, most, std::ceil(1.1 * ranks * values / most)));
}

}   // namespace

/// The rows of this rank, split by whose the columns are.
class TangentMatrix::Pattern {
public:
  explicit Pattern(const partition::LocalNetwork& network)
      : network_(network),
        own_(block_rows(network.owned, [this](const auto& visit) { for_each_pair(true, visit); })),
        other_(block_rows(network.owned, [this](const auto& visit) { for_each_pair(false, visit); })) {
    own_.place(network.blocks, network.first_number);
    other_.place(network.blocks, network.first_number);
    written_[0].assign(own_.column.size(), false);
    written_[1].assign(other_.column.size(), false);
  }

  Slot slot(LocalNode row, LocalNode column) {
    if (!network_.is_owned(row) || !network_.is_free(column)) return {};
    const bool other = !network_.is_owned(column);
    const BlockRows& rows = other ? other_ : own_;
    const int block = rows.block(row, network_.number(column));
    Slot slot;
    slot.offset = rows.row_values(row.value()) + rows.column_values(row.value(), block);
    slot.stride = static_cast<unsigned>(rows.width(row.value(), size(network_.number(row)))) & 0x1fffffff;
    slot.other = other;
    slot.absent = 0;
    slot.add = written_[slot.other][at(block)];
    written_[slot.other][at(block)] = true;
    return slot;
  }

  ElementSlots slots(const std::array<LocalNode, 2>& node) {
    const LocalNode a = network_.anchor(node[0]), b = network_.anchor(node[1]);
    const Slot none;
    return {network_.is_carried(node[0]) ? none : slot(a, a), a == b ? none : slot(a, b), a == b ? none : slot(b, a),
            network_.is_carried(node[1]) ? none : slot(b, b)};
  }

  void preallocate(Mat matrix) const {
    std::vector<PetscInt> first{0}, columns;
    first.reserve(at(network_.unknowns()) + 1);
    columns.reserve(9 * (own_.column.size() + other_.column.size()));
    for (int row = 0; row < network_.owned; ++row)
      for (int r = 0; r < size(network_.first_number + row); ++r) {
        const std::size_t begin = columns.size();
        for (const BlockRows* rows : {&own_, &other_})
          for (int i = rows->first[at(row)]; i < rows->first[at(row) + 1]; ++i) {
            const SolverNumber column = rows->column[at(i)];
            for (int c = 0; c < size(column); ++c) columns.push_back(network_.blocks.begin(column) + c);
          }
        std::sort(columns.begin() + static_cast<std::ptrdiff_t>(begin), columns.end());
        first.push_back(static_cast<PetscInt>(columns.size()));
      }
    check(MatSeqAIJSetPreallocationCSR(matrix, first.data(), columns.data(), nullptr));
    check(MatMPIAIJSetPreallocationCSR(matrix, first.data(), columns.data(), nullptr));
  }

private:
  int size(SolverNumber number) const { return network_.blocks.size(number); }

  /// Owned nodes and their free neighbours, themselves among them, of this rank or of others; by solver number.
  template <class Visit>
  void for_each_pair(bool own, const Visit& visit) const {
    if (own)
      for (LocalNode node(0); network_.is_owned(node); ++node) visit(node, network_.number(node));
    const auto join = [&](LocalNode row, LocalNode column) {
      if (network_.is_owned(row) && network_.is_free(column) && network_.is_owned(column) == own)
        visit(row, network_.number(column));
    };
    const auto join_ends = [&](const std::array<LocalNode, 2>& node) {
      const LocalNode a = network_.anchor(node[0]), b = network_.anchor(node[1]);
      join(a, b);
      join(b, a);
    };
    for (const auto& element : network_.elements) join_ends(element.node);
    for (const auto& link : network_.links) join_ends(link.node);
  }

  const partition::LocalNetwork& network_;
  BlockRows own_, other_;
  std::array<std::vector<bool>, 2> written_;
};

TangentMatrix::TangentMatrix(const partition::LocalNetwork& network, bool symmetric, MPI_Comm communicator) {
  check_size(network, communicator);
  Pattern pattern(network);
  const PetscInt rows = network.unknowns(), all = network.all_unknowns();
  check(MatCreate(communicator, aij_.out()));
  check(MatSetSizes(aij_, rows, rows, all, all));
  if (network.blocks.uniform()) check(MatSetBlockSize(aij_, 3));
  check(MatSetType(aij_, MATAIJ));
  pattern.preallocate(aij_);
  check(MatSetOption(aij_, MAT_NEW_NONZERO_LOCATION_ERR, PETSC_TRUE));
  if (symmetric) {
    check(MatSetOption(aij_, MAT_SYMMETRIC, PETSC_TRUE));
    check(MatSetOption(aij_, MAT_SYMMETRY_ETERNAL, PETSC_TRUE));
  }
  PetscBool distributed = PETSC_FALSE;
  check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(static_cast<Mat>(aij_)), MATMPIAIJ, &distributed));
  parts_[0] = aij_;
  if (distributed) check(MatMPIAIJGetSeqAIJ(aij_, &parts_[0], &parts_[1], nullptr));
  for (const auto& element : network.elements) element_slots_.push_back(pattern.slots(element.node));
  for (const auto& link : network.links) link_slots_.push_back(pattern.slots(link.node));
  for (int b = 0; b < network.own_bodies; ++b)
    body_slots_.push_back(pattern.slot(network.bodies[at(b)].node, network.bodies[at(b)].node));
  for (const auto& load : network.loads) load_slots_.push_back(pattern.slot(load.node, load.node));
  for (const auto& wet : network.wet_points)
    wet_slots_.push_back(network.is_carried(wet.node) ? Slot{} : pattern.slot(wet.node, wet.node));

  std::array<char, 64> type{};
  PetscBool chosen = PETSC_FALSE;
  check(PetscOptionsGetString(nullptr, nullptr, "-mat_type", type.data(), type.size(), &chosen));
  const std::string name = type.data();
  if (!chosen || name == MATAIJ || name == MATSEQAIJ || name == MATMPIAIJ) return;
  // Some conversions take a distributed matrix apart, and its arrays with it.
  Matrix copy;
  check(MatDuplicate(aij_, MAT_COPY_VALUES, copy.out()));
  check(MatConvert(copy, name.c_str(), MAT_INITIAL_MATRIX, converted_.out()));
}

std::array<double*, 2> TangentMatrix::open() {
  for (std::size_t i = 0; i < 2; ++i)
    if (parts_[i] != nullptr) check(MatSeqAIJGetArrayWrite(parts_[i], &values_[i]));
  return values_;
}

void TangentMatrix::close() {
  for (std::size_t i = 0; i < 2; ++i)
    if (parts_[i] != nullptr) check(MatSeqAIJRestoreArrayWrite(parts_[i], &values_[i]));
}

void TangentMatrix::publish() {
  petsc::mark_changed(aij_);
  if (converted_ == nullptr) return;
  // A conversion would make variants of AIJ anew, and lose what solvers hold.
  check(MatCopy(aij_, converted_, SAME_NONZERO_PATTERN));
}

void TangentMatrix::set_identity(double s) {
  check(MatZeroEntries(aij_));
  check(MatShift(aij_, s));
  publish();
}

}   // namespace cablenet::system
