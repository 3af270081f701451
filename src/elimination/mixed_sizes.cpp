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

void load(BlockMap block, const BlockSource& source, bool touched, const Arrays& arrays) {
  if (source.absent) return;
  const double* from = arrays[source.array] + source.offset;
  const Eigen::Index down = source.transposed ? 1 : source.stride;
  const Eigen::Index right = source.transposed ? source.stride : 1;
  for (Eigen::Index r = 0; r < block.rows(); ++r)
    for (Eigen::Index c = 0; c < block.cols(); ++c) {
      const double value = from[r * down + c * right];
      block(r, c) = touched ? block(r, c) + value : value;
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
  for (const int size : schedule_.size) begin_.push_back(std::exchange(unknown, unknown + size));
  exchanges_.resize(largest_block * at(schedule_.eliminated()));
}

Pivots Elimination::factor_mixed(const Arrays& arrays) {
  Pivots pivots;
  const std::int64_t* target = schedule_.targets.data();
  std::size_t number = 0;
  const auto load_next = [&](double* to, int rows, int columns) {
    load({to, rows, columns}, sources_[number], schedule_.touched[number], arrays);
    ++number;
  };
  for (int k = 0; k < schedule_.eliminated(); ++k) {
    const Schedule::Node& node = schedule_.nodes[at(k)];
    const int own = schedule_.size[at(k)];
    int* const exchanges = exchanges_.data() + largest_block * k;
    load_next(values_.data() + node.values, own, own);
    const int sign = elimination::factor({values_.data() + node.values, own, own}, exchanges);
    if (sign == 0) return {k, pivots.negative, pivots.first_negative};
    if (sign < 0 && pivots.negative++ == 0) pivots.first_negative = k;
    visit_later(k, [&](double* upper, double* lower, int size, int) {
      load_next(upper, own, size);
      load_next(lower, size, own);
      divide_right({values_.data() + node.values, own, own}, exchanges, {lower, size, own});
    });
    visit_later(k, [&](double*, double* lower, int rows, int) {
      visit_later(k, [&](double* upper, double*, int columns, int) {
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
  const Schedule::Node& node = schedule_.nodes[at(k)];
  const int own = schedule_.size[at(k)];
  double* block = values_.data() + node.values + own * own;
  for (int i = node.first_later; i < schedule_.nodes[at(k) + 1].first_later; ++i) {
    const int size = schedule_.size[at(schedule_.later[at(i)])];
    visit(block, block + own * size, size, begin_[at(schedule_.later[at(i)])]);
    block += 2 * own * size;
  }
}

void Elimination::forward_mixed(double* w) {
  for (int k = 0; k < schedule_.eliminated(); ++k) {
    const int own = schedule_.size[at(k)];
    visit_later(k, [&](double*, double* lower, int size, int begin) {
      ColumnMap(w + begin, size) -= BlockMap(lower, size, own).lazyProduct(ColumnMap(w + begin_[at(k)], own));
    });
  }
}

void Elimination::backward_mixed(double* w) {
  for (int k = schedule_.eliminated() - 1; k >= 0; --k) {
    const int own = schedule_.size[at(k)];
    ColumnMap mine(w + begin_[at(k)], own);
    visit_later(k, [&](double* upper, double*, int size, int begin) {
      mine -= BlockMap(upper, own, size).lazyProduct(ColumnMap(w + begin, size));
    });
    solve({values_.data() + schedule_.nodes[at(k)].values, own, own}, exchanges_.data() + largest_block * k, mine);
  }
}

}   // namespace cablenet::elimination
