#include "matrix_blocks.hpp"

#include <algorithm>

#include "cablenet/petsc/handle.hpp"

namespace cablenet::solve {

using petsc::check;

MatrixBlocks::MatrixBlocks(Mat matrix, const partition::Blocks& blocks) : blocks_(blocks) {
  PetscBool distributed = PETSC_FALSE;
  check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(matrix), MATMPIAIJ, &distributed));
  parts_[0].matrix = matrix;
  if (distributed) check(MatMPIAIJGetSeqAIJ(matrix, &parts_[0].matrix, &parts_[1].matrix, &names_));
  PetscInt begin = 0, end = 0;
  check(MatGetOwnershipRange(matrix, &begin, &end));
  first_unknown_ = begin;
  first_ = blocks.block_of(static_cast<int>(begin));
  rows_ = blocks.block_of(static_cast<int>(end)) - first_;
  for (Part& part : parts_) {
    PetscBool done = PETSC_TRUE;
    if (part.matrix != nullptr)
      check(MatGetRowIJ(part.matrix, 0, PETSC_FALSE, PETSC_FALSE, &part.count, &part.row, &part.column, &done));
    if (done == PETSC_FALSE) throw petsc::Failure("the matrix does not show its rows; it must be of type aij");
  }
  if (!blocks.uniform()) find_mixed();
}

MatrixBlocks::~MatrixBlocks() {
  PetscBool done = PETSC_TRUE;
  for (Part& part : parts_)
    if (part.matrix != nullptr)
      (void)MatRestoreRowIJ(part.matrix, 0, PETSC_FALSE, PETSC_FALSE, &part.count, &part.row, &part.column, &done);
}

void MatrixBlocks::find_mixed() {
  for (int row = 0; row < rows_; ++row) {
    const int size = blocks_.size(first_ + row);
    begin_.push_back(static_cast<int>(parts_[0].mixed.size()));
    parts_[0].mixed.insert(parts_[0].mixed.end(), at(size), {first_ + row, size});
  }
  begin_.push_back(static_cast<int>(parts_[0].mixed.size()));
  if (parts_[1].matrix == nullptr) return;
  PetscInt columns = 0;
  check(MatGetLocalSize(parts_[1].matrix, nullptr, &columns));
  for (PetscInt local = 0; local < columns; ++local) {
    const SolverNumber block = blocks_.block_of(static_cast<int>(names_[local]));
    parts_[1].mixed.push_back({block, blocks_.size(block)});
  }
}

elimination::BlockSource MatrixBlocks::find(int row, SolverNumber column) const {
  const unsigned index = is_own(column) ? 0 : 1;
  const Part& part = parts_[index];
  if (part.matrix == nullptr) return {};
  const PetscInt* const row_of_part = part.row + begin(row);
  const PetscInt* const start = part.column + row_of_part[0];
  const PetscInt* const end = part.column + row_of_part[1];
  const auto name = [&](PetscInt local) { return index == 0 ? local + first_unknown_ : names_[local]; };
  const PetscInt wanted = blocks_.begin(column);
  const PetscInt* found =
      std::lower_bound(start, end, wanted, [&](PetscInt local, PetscInt w) { return name(local) < w; });
  if (found == end || name(*found) != wanted) return {};
  return elimination::block_source(static_cast<int>(found - part.column), static_cast<int>(end - start), index);
}

elimination::Arrays MatrixBlocks::values(const double* exchanged) const {
  elimination::Arrays arrays{nullptr, nullptr, exchanged};
  for (std::size_t i = 0; i < 2; ++i)
    if (parts_[i].matrix != nullptr) check(MatSeqAIJGetArrayRead(parts_[i].matrix, &arrays[i]));
  return arrays;
}

void MatrixBlocks::release(elimination::Arrays& arrays) const {
  for (std::size_t i = 0; i < 2; ++i)
    if (parts_[i].matrix != nullptr) check(MatSeqAIJRestoreArrayRead(parts_[i].matrix, &arrays[i]));
}

}   // namespace cablenet::solve
