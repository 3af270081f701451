#include "matrix_blocks.hpp"

#include <algorithm>

#include "cablenet/petsc/handle.hpp"

namespace cablenet::solve {

using petsc::check;

MatrixBlocks::MatrixBlocks(Mat matrix) {
  PetscBool distributed = PETSC_FALSE;
  check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(matrix), MATMPIAIJ, &distributed));
  parts_[0].matrix = matrix;
  if (distributed) check(MatMPIAIJGetSeqAIJ(matrix, &parts_[0].matrix, &parts_[1].matrix, &names_));
  PetscInt begin = 0, end = 0;
  check(MatGetOwnershipRange(matrix, &begin, &end));
  first_ = static_cast<int>(begin / 3);
  rows_ = static_cast<int>((end - begin) / 3);
  for (Part& part : parts_) {
    PetscBool done = PETSC_TRUE;
    if (part.matrix != nullptr)
      check(MatGetRowIJ(part.matrix, 0, PETSC_FALSE, PETSC_FALSE, &part.count, &part.row, &part.column, &done));
    if (done == PETSC_FALSE) throw petsc::Failure("the matrix does not show its rows; it must be of type aij");
  }
}

MatrixBlocks::~MatrixBlocks() {
  PetscBool done = PETSC_TRUE;
  for (Part& part : parts_)
    if (part.matrix != nullptr)
      (void)MatRestoreRowIJ(part.matrix, 0, PETSC_FALSE, PETSC_FALSE, &part.count, &part.row, &part.column, &done);
}

elimination::BlockSource MatrixBlocks::find(int row, int column) const {
  const unsigned index = is_own(column) ? 0 : 1;
  const Part& part = parts_[index];
  if (part.matrix == nullptr) return {};
  const PetscInt* const begin = part.column + part.row[3 * row];
  const PetscInt* const end = part.column + part.row[3 * row + 1];
  const auto name = [&](PetscInt local) { return index == 0 ? local + 3 * first_ : names_[local]; };
  const PetscInt wanted = 3 * column;
  const PetscInt* found =
      std::lower_bound(begin, end, wanted, [&](PetscInt local, PetscInt w) { return name(local) < w; });
  if (found == end || name(*found) != wanted) return {};
  return elimination::block_source(static_cast<int>(found - part.column), static_cast<int>(end - begin), index);
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
