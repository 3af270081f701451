#include <algorithm>

#include "cablenet/elimination/elimination.hpp"
#include "exchanged_rows.hpp"
#include "inertia.hpp"
#include "sized_kernels.hpp"
#include "uniform_kernels.hpp"

/// This file has the steps of an elimination at which not all blocks are 3x3.
namespace cablenet::elimination {
namespace {

/// @returns the number of negative pivots where they tell, or -1 if the pivot block is singular
int factor_pivot(double* pivot, int*, Size<3>) { return factor_block(pivot); }
template <class Own>
int factor_pivot(double* pivot, int* origin, Own own) {
  return factor_block(pivot, origin, own) ? 0 : -1;
}

template <class Rows>
void divide_by_pivot(double* lower, const double* pivot, const int*, Rows rows, Size<3>) {
  divide_right(lower, pivot, rows);
}
template <class Rows, class Own>
void divide_by_pivot(double* lower, const double* pivot, const int* origin, Rows rows, Own own) {
  divide_right(lower, pivot, origin, rows, own);
}

void solve_pivot(double* w, const double* pivot, const int*, Size<3>) { divide_left(w, pivot); }
template <class Own>
void solve_pivot(double* w, const double* pivot, const int* origin, Own own) {
  divide_left(w, pivot, origin, own);
}

}   // namespace

void Elimination::prepare_mixed() {
  int unknown = 0, exchanges = 0, copies = 0;
  for (const int size : plan_.size) {
    begin_.push_back(unknown);
    unknown += size;
  }
  begin_.push_back(unknown);
  for (int k = 0; k < plan_.eliminated(); ++k) {
    const int own = plan_.size[at(k)];
    const auto later = plan_.later.begin();
    if (own == 3 && std::all_of(later + plan_.first_later[at(k)], later + plan_.first_later[at(k) + 1],
                                [this](int j) { return plan_.size[at(j)] == 3; }))
      continue;
    large_.push_back({k, exchanges, copies});
    if (own == 3) continue;
    exchanges += own;
    copies += own * own;
  }
  origins_.resize(at(exchanges));
  bodies_.resize(at(copies));
}

int Elimination::negative_in_bodies() const {
  int negative = 0;
  for (const Large& large : large_)
    if (const int own = plan_.size[at(large.block)]; own != 3)
      negative += negative_eigenvalues(bodies_.data() + large.copy, own);
  return negative;
}

template <class Visit>
void Elimination::visit_later(int k, Visit&& visit) {
  for (int i = plan_.first_later[at(k)]; i < plan_.first_later[at(k) + 1]; ++i) {
    double* const upper = values_.data() + plan_.upper_values + plan_.coupling(i);
    double* const lower = values_.data() + plan_.lower_values + plan_.coupling(i);
    visit(upper, lower, plan_.later[at(i)]);
  }
}

template <class Own>
int Elimination::factor_step(const Large& step, Own own, const Arrays& arrays, const std::int64_t*& target) {
  const int k = step.block;
  double* const pivot = values_.data() + plan_.pivot(k);
  int* const origin = origins_.data() + step.origins;
  const BlockSource* source = sources_.data() + k + 2 * std::ptrdiff_t{plan_.first_later[at(k)]};
  load_block(pivot, *source++, arrays, own, own);
  if (own != 3) std::copy_n(pivot, own * own, bodies_.data() + step.copy);
  const int negative = factor_pivot(pivot, origin, own);
  if (negative < 0) return negative;
  visit_later(k, [&](double* upper, double* lower, int j) {
    with_size(plan_.size[at(j)], [&](auto size) {
      load_block(upper, *source++, arrays, own, size);
      load_block(lower, *source++, arrays, size, own);
      divide_by_pivot(lower, pivot, origin, size, own);
    });
  });
  visit_later(k, [&](double*, double* lower, int i) {
    with_size(plan_.size[at(i)], [&](auto rows) {
      visit_later(k, [&](double* upper, double*, int j) {
        const std::int64_t offset = *target++;
        with_size(plan_.size[at(j)], [&](auto columns) {
          update_block(values_.data() + (offset < 0 ? ~offset : offset), offset < 0, lower, upper, rows, own, columns);
        });
      });
    });
  });
  return negative;
}

int Elimination::factor_large(const Large& step, const Arrays& arrays, const std::int64_t*& target) {
  int negative = 0;
  with_size(plan_.size[at(step.block)], [&](auto own) { negative = factor_step(step, own, arrays, target); });
  return negative;
}

void Elimination::forward_large(const Large& step, const Joined<double>& x) {
  const double* const mine = x.eliminated + begin_[at(step.block)];
  with_size(plan_.size[at(step.block)], [&](auto own) {
    visit_later(step.block, [&](double*, double* lower, int j) {
      double* const to = x.at(begin_[at(j)]);
      with_size(plan_.size[at(j)], [&](auto size) { subtract_product(to, lower, mine, size, own); });
    });
  });
}

void Elimination::backward_large(const Large& step, double* w, const Joined<const double>& x) {
  double* const mine = w + begin_[at(step.block)];
  with_size(plan_.size[at(step.block)], [&](auto own) {
    visit_later(step.block, [&](double* upper, double*, int j) {
      const double* const from = x.at(begin_[at(j)]);
      with_size(plan_.size[at(j)], [&](auto size) { subtract_product(mine, upper, from, own, size); });
    });
    solve_pivot(mine, values_.data() + plan_.pivot(step.block), origins_.data() + step.origins, own);
  });
}

}   // namespace cablenet::elimination
