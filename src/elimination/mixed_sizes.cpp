#include <Eigen/LU>
#include <utility>

#include "cablenet/elimination/elimination.hpp"

/// The same elimination for blocks of different sizes, as bodies have: row exchanges within each pivot.
namespace cablenet::elimination {
namespace {

std::size_t at(std::int64_t index) { return static_cast<std::size_t>(index); }

using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, largest_block, largest_block>;
using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, largest_block, 1>;
using BlockMap = Eigen::Map<Block>;
using ColumnMap = Eigen::Map<Column>;

void load(BlockMap block, const BlockSource& source, const Arrays& arrays) {
  if (source.absent) return;
  const double* from = arrays[source.array] + source.offset;
  const Eigen::Index down = source.transposed ? 1 : source.stride;
  const Eigen::Index right = source.transposed ? source.stride : 1;
  for (Eigen::Index r = 0; r < block.rows(); ++r)
    for (Eigen::Index c = 0; c < block.cols(); ++c) {
      const double value = from[r * down + c * right];
      block(r, c) = source.touched ? block(r, c) + value : value;
    }
}

/// P A = L U in place, rows exchanged for the largest pivot.
/// @returns the sign of A's determinant, 0 if A is singular to rounding.
int factor(BlockMap a, int* exchanges) {
  const double least = std::numeric_limits<double>::epsilon() * a.cwiseAbs().maxCoeff();
  int sign = 1;
  for (Eigen::Index k = 0; k < a.rows(); ++k) {
    Eigen::Index best = 0;
    const double largest = a.col(k).tail(a.rows() - k).cwiseAbs().maxCoeff(&best);
    if (!(largest > least)) return 0;
    exchanges[k] = static_cast<int>(k + best);
    if (best != 0) a.row(k).swap(a.row(k + best)), sign = -sign;
    if (a(k, k) < 0) sign = -sign;
    const Eigen::Index rest = a.rows() - k - 1;
    a.col(k).tail(rest) /= a(k, k);
    a.bottomRightCorner(rest, rest) -= (a.col(k).tail(rest) * a.row(k).tail(rest)).eval();
  }
  return sign;
}

void solve(const BlockMap& lu, const int* exchanges, Eigen::Ref<Column> w) {
  for (Eigen::Index k = 0; k < lu.rows(); ++k) std::swap(w(k), w(exchanges[k]));
  lu.triangularView<Eigen::UnitLower>().solveInPlace(w);
  lu.triangularView<Eigen::Upper>().solveInPlace(w);
}

/// rows := rows A^-1.
void divide_right(const BlockMap& lu, const int* exchanges, BlockMap rows) {
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    Column w = rows.row(r).transpose();
    lu.triangularView<Eigen::Upper>().transpose().solveInPlace(w);
    lu.triangularView<Eigen::UnitLower>().transpose().solveInPlace(w);
    for (Eigen::Index k = lu.rows() - 1; k >= 0; --k) std::swap(w(k), w(exchanges[k]));
    rows.row(r) = w.transpose();
  }
}

}   // namespace

void Elimination::prepare_mixed() {
  int unknown = 0;
  for (std::size_t k = 0; k < schedule_.size.size(); ++k) {
    if (k == at(schedule_.eliminated())) unknown = 0;
    begin_.push_back(unknown);
    unknown += schedule_.size[k];
  }
  exchanges_.resize(largest_block * at(schedule_.eliminated()));
}

Pivots Elimination::factor_mixed(const Arrays& arrays) {
  Pivots pivots;
  const std::int64_t* target = schedule_.targets.data();
  std::size_t number = 0;
  const auto load_next = [&](double* to, int rows, int columns) {
    load({to, rows, columns}, sources_[number++], arrays);
  };
  for (int k = 0; k < schedule_.eliminated(); ++k) {
    const int own = schedule_.size[at(k)];
    double* const pivot = values_.data() + schedule_.pivot(k);
    int* const exchanges = exchanges_.data() + largest_block * k;
    load_next(pivot, own, own);
    const int sign = elimination::factor({pivot, own, own}, exchanges);
    if (sign == 0) return {k, pivots.negative};
    if (sign < 0) ++pivots.negative;
    visit_later(k, [&](double* upper, double* lower, int j) {
      const int size = schedule_.size[at(j)];
      load_next(upper, own, size);
      load_next(lower, size, own);
      divide_right({pivot, own, own}, exchanges, {lower, size, own});
    });
    visit_later(k, [&](double*, double* lower, int i) {
      visit_later(k, [&](double* upper, double*, int j) {
        const int rows = schedule_.size[at(i)], columns = schedule_.size[at(j)];
        const bool first = *target < 0;
        BlockMap to(values_.data() + (first ? ~*target : *target), rows, columns);
        ++target;
        if (first) to.setZero();
        to.noalias() -= BlockMap(lower, rows, own).lazyProduct(BlockMap(upper, own, columns));
      });
    });
  }
  return pivots;
}

template <class Visit>
void Elimination::visit_later(int k, Visit&& visit) {
  for (int i = schedule_.first_later[at(k)]; i < schedule_.first_later[at(k) + 1]; ++i) {
    double* const upper = values_.data() + schedule_.upper_values + schedule_.coupling(i);
    double* const lower = values_.data() + schedule_.lower_values + schedule_.coupling(i);
    visit(upper, lower, schedule_.later[at(i)]);
  }
}

void Elimination::forward_mixed(double* w, double* kept) {
  for (int k = 0; k < schedule_.eliminated(); ++k) {
    const int own = schedule_.size[at(k)];
    visit_later(k, [&](double*, double* lower, int j) {
      double* const to = (j < schedule_.eliminated() ? w : kept) + begin_[at(j)];
      const int size = schedule_.size[at(j)];
      ColumnMap(to, size) -= BlockMap(lower, size, own).lazyProduct(ColumnMap(w + begin_[at(k)], own));
    });
  }
}

void Elimination::backward_mixed(double* w, const double* kept) {
  for (int k = schedule_.eliminated() - 1; k >= 0; --k) {
    const int own = schedule_.size[at(k)];
    ColumnMap mine(w + begin_[at(k)], own);
    visit_later(k, [&](double* upper, double*, int j) {
      const double* const from = (j < schedule_.eliminated() ? w : kept) + begin_[at(j)];
      const int size = schedule_.size[at(j)];
      mine -= BlockMap(upper, own, size).lazyProduct(Eigen::Map<const Column>(from, size));
    });
    solve({values_.data() + schedule_.pivot(k), own, own}, exchanges_.data() + largest_block * k, mine);
  }
}

}   // namespace cablenet::elimination
