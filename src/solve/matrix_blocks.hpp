#pragma once
#include <petscmat.h>

#include <vector>

#include "cablenet/elimination/elimination.hpp"
#include "cablenet/partition/blocks.hpp"

namespace cablenet::solve {

/// This rank's rows of an AIJ matrix as blocks.  Columns are block numbers of the whole matrix.
/// @pre the rows of a block have the same columns, and these come in whole blocks
class MatrixBlocks {
public:
  /// @param blocks  of the whole matrix; must stay
  MatrixBlocks(Mat matrix, const partition::Blocks& blocks);
  ~MatrixBlocks();
  MatrixBlocks(const MatrixBlocks&) = delete;
  MatrixBlocks& operator=(const MatrixBlocks&) = delete;

  int rows() const { return rows_; }
  int first() const { return first_; }
  /// Of a local row, and of all rows: its first unknown on this rank.
  int begin(int row) const { return is_uniform() ? 3 * row : begin_[static_cast<std::size_t>(row)]; }
  bool is_own(int column) const { return column >= first_ && column < first_ + rows_; }
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
  elimination::BlockSource find(int row, int column) const;

  /// The two arrays of values, until release().  @param exchanged  the third array that sources may refer to
  elimination::Arrays values(const double* exchanged) const;
  void release(elimination::Arrays& arrays) const;

private:
  struct Column {
    int block, size;
  };
  struct Part {
    Mat matrix = nullptr;
    PetscInt count = 0;
    const PetscInt* row = nullptr;
    const PetscInt* column = nullptr;
    std::vector<Column> mixed;   ///< per column of the part, if not all sizes are 3
  };

  static std::size_t at(PetscInt index) { return static_cast<std::size_t>(index); }
  bool is_uniform() const { return begin_.empty(); }
  int uniform_column(unsigned part, PetscInt local) const {
    return static_cast<int>(part == 0 ? first_ + local / 3 : names_[local] / 3);
  }
  void find_mixed();

  const partition::Blocks& blocks_;
  Part parts_[2];
  const PetscInt* names_ = nullptr;   ///< of the second part's columns in the whole matrix
  int rows_ = 0;
  int first_ = 0;
  PetscInt first_unknown_ = 0;
  std::vector<int> begin_;   ///< if not all sizes are 3: per row, and one past the last
};

}   // namespace cablenet::solve
