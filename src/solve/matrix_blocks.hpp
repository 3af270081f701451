#pragma once
#include <petscmat.h>

#include "cablenet/elimination/elimination.hpp"

namespace cablenet::solve {

/// This rank's rows of an AIJ matrix as 3x3 blocks.  Columns are block numbers of the whole matrix.
class MatrixBlocks {
public:
  explicit MatrixBlocks(Mat matrix);
  ~MatrixBlocks();
  MatrixBlocks(const MatrixBlocks&) = delete;
  MatrixBlocks& operator=(const MatrixBlocks&) = delete;

  int rows() const { return rows_; }
  int first() const { return first_; }
  bool is_own(int column) const { return column >= first_ && column < first_ + rows_; }
  /// visit(column, source) for each block of a local row; the source is in values()'s arrays.
  template <class Visit>
  void for_each(int row, Visit&& visit) const {
    for (unsigned part = 0; part < 2; ++part) {
      const Part& p = parts_[part];
      if (p.matrix == nullptr) continue;
      const PetscInt begin = p.row[3 * row];
      const PetscInt length = p.row[3 * row + 1] - begin;
      for (PetscInt i = 0; i < length; i += 3) {
        const PetscInt local = p.column[begin + i];
        const int column = static_cast<int>(part == 0 ? first_ + local / 3 : names_[local] / 3);
        visit(column, elimination::block_source(static_cast<int>(begin + i), static_cast<int>(length), part));
      }
    }
  }
  elimination::BlockSource find(int row, int column) const;

  /// The two arrays of values, until release().  @param exchanged  the third array that sources may refer to
  elimination::Arrays values(const double* exchanged) const;
  void release(elimination::Arrays& arrays) const;

private:
  struct Part {
    Mat matrix = nullptr;
    PetscInt count = 0;
    const PetscInt* row = nullptr;
    const PetscInt* column = nullptr;
  };

  Part parts_[2];
  const PetscInt* names_ = nullptr;   ///< of the second part's columns in the whole matrix
  int rows_ = 0;
  int first_ = 0;
};

}   // namespace cablenet::solve
