#include "cablenet/system/tangent_matrix.hpp"

#include <string>

#include "block_pattern.hpp"
#include "cablenet/petsc/object_state.hpp"

namespace cablenet::system {

using petsc::check;

TangentMatrix::TangentMatrix(const partition::LocalNetwork& network, const BlockPattern& pattern, bool symmetric,
                             MPI_Comm communicator) {
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
  convert();
}

void TangentMatrix::convert() {
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
