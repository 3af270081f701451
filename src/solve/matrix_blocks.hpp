#pragma once
#include <petscmat.h>

#include <vector>

#include "cablenet/elimination/elimination.hpp"
#include "cablenet/partition/blocks.hpp"

namespace cablenet::solve {

/// This rank's rows of an AIJ matrix as blocks.  Columns are the whole matrix's blocks.
/// @pre the rows of a block have the same columns, and these come in whole blocks
class MatrixBlocks {
public:
  /// @param blocks  of the whole matrix; must outlive this
  MatrixBlocks(Mat matrix, const partition::Blocks& blocks);
  ~MatrixBlocks();
  MatrixBlocks(const MatrixBlocks&) = delete;
  MatrixBlocks& operator=(const MatrixBlocks&) = delete;

  int rows() const { return rows_; }
  SolverNumber first() const { return first_; }
  /// The first unknown of a local row.  That of row rows(), one past the last, is the number of unknowns on this rank.
  int begin(int row) const { return is_uniform() ? 3 * row : begin_[at(row)]; }
  bool is_own(SolverNumber column) const { return column >= first_ && column < first_ + rows_; }
  /// visit(column, source) for each block of a local row; the source is in values()'s arrays.
  template <class Visit>
  void for_each(int row, Visit&& visit) const {
    for (unsigned part = 0; part < 2; ++part) {
      const Part& p = parts_[part];
      if (p.matrix == nullptr) continue;
      const PetscInt start = p.row[begin(row)];
      const PetscInt length = p.row[begin(row) + 1] - start;
      const auto source = [&](PetscInt i) {
        return elimination::block_source(static_cast<int>(start + i), static_cast<int>(length), part);
      };
      if (is_uniform())
        for (PetscInt i = 0; i < length; i += 3) visit(uniform_column(part, p.column[start + i]), source(i));
      else
        for (PetscInt i = 0; i < length; i += p.mixed[at(p.column[start + i])].size)
          visit(p.mixed[at(p.column[start + i])].block, source(i));
    }
  }
  elimination::BlockSource find(int row, SolverNumber column) const;

  /// The two arrays of values, until release().  @param exchanged  the third array that sources may refer to
  elimination::Arrays values(const double* exchanged) const;
  void release(elimination::Arrays& arrays) const;

private:
  struct Column {
    SolverNumber block;
    int size;
  };
  struct Part {
    Mat matrix = nullptr;
    PetscInt count = 0;
    const PetscInt* row = nullptr;
    const PetscInt* column = nullptr;
    std::vector<Column> mixed;   ///< per column of the part, if not all sizes are 3
  };

  bool is_uniform() const { return begin_.empty(); }
  SolverNumber uniform_column(unsigned part, PetscInt local) const {
    return part == 0 ? first_ + static_cast<int>(local / 3) : SolverNumber(static_cast<int>(names_[local] / 3));
  }
  void find_mixed();

  const partition::Blocks& blocks_;
  Part parts_[2];
  const PetscInt* names_ = nullptr;   ///< of the second part's columns in the whole matrix
  int rows_ = 0;
  SolverNumber first_;
  PetscInt first_unknown_ = 0;
  std::vector<int> begin_;   ///< if not all sizes are 3: per row, and one past the last
};

}   // namespace cablenet::solve
