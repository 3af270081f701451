#include "cablenet/elimination/elimination.hpp"

#include <algorithm>
#include <utility>

#include "uniform_kernels.hpp"

namespace cablenet::elimination {
namespace {

std::size_t at(std::int64_t index) { return static_cast<std::size_t>(index); }

/// Nodes of a chain: there are more streams through memory than processors foresee, so they are told.
constexpr std::ptrdiff_t ahead = 20;

void fetch(const double* values, int lines) {
  for (std::ptrdiff_t i = 0; i < lines; ++i) __builtin_prefetch(values + 8 * i);
}

}   // namespace

Elimination::Elimination(Schedule schedule, const std::function<BlockSource(int, int)>& where)
    : schedule_(std::move(schedule)) {
  sources_.reserve(schedule_.touched.size());
  int most_later = 0;
  for (int k = 0; k < schedule_.eliminated(); ++k) {
    const int begin = schedule_.first_later[at(k)], end = schedule_.first_later[at(k) + 1];
    add_source(where(k, k));
    for (int i = begin; i < end; ++i) {
      if (!schedule_.symmetric) add_source(where(k, schedule_.later[at(i)]));
      add_source(where(schedule_.later[at(i)], k));
    }
    most_later = std::max(most_later, end - begin);
  }
  std::vector<bool>().swap(schedule_.touched);
  values_.resize(at(schedule_.values));
  column_.resize(9 * at(most_later));
  if (!schedule_.uniform) prepare_mixed();
}

void Elimination::add_source(BlockSource source) {
  source.touched = schedule_.touched[sources_.size()];
  sources_.push_back(source);
}

Pivots Elimination::factor(const Arrays& arrays) {
  std::fill(values_.begin() + schedule_.kept_values, values_.end(), 0.0);
  if (!schedule_.uniform) return factor_mixed(arrays);
  return schedule_.symmetric ? factor_uniform<true>(arrays) : factor_uniform<false>(arrays);
}

template <bool symmetric>
Pivots Elimination::factor_uniform(const Arrays& arrays) {
  Pivots pivots;
  double* const values = values_.data();
  double* pivot = values;
  double* upper = symmetric ? column_.data() : values + schedule_.upper_values;
  double* lower = values + schedule_.lower_values;
  const std::int64_t* target = schedule_.targets.data();
  const BlockSource* source = sources_.data();
  for (int k = 0; k < schedule_.eliminated(); ++k, pivot += 9) {
    const int count = schedule_.first_later[at(k) + 1] - schedule_.first_later[at(k)];
    fetch(arrays[source->array] + source->offset + 27 * ahead, 4);
    for (const double* to : {pivot, lower, upper}) fetch(to + 9 * ahead, 1);
    load_block(pivot, *source++, arrays);
    const int negative = factor_block(pivot);
    if (negative < 0) return {k, pivots.negative};
    pivots.negative += negative;
    for (int i = 0; i < count; ++i) {
      if constexpr (!symmetric) load_block(upper + 9 * i, *source++, arrays);
      load_block(lower + 9 * i, *source++, arrays);
      if constexpr (symmetric) transpose_block(upper + 9 * i, lower + 9 * i);
      divide_right(lower + 9 * i, pivot);
    }
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < (symmetric ? i + 1 : count); ++j, ++target)
        update_block(values + (*target < 0 ? ~*target : *target), *target < 0, lower + 9 * i, upper + 9 * j);
    lower += 9 * count;
    if constexpr (!symmetric) upper += 9 * count;
  }
  return pivots;
}

void Elimination::forward_uniform(double* w, double* kept) {
  double* const shifted = kept - 3 * std::ptrdiff_t{schedule_.eliminated()};
  const double* lower = values_.data() + schedule_.lower_values;
  const int* later = schedule_.later.data();
  for (int k = 0; k < schedule_.eliminated(); ++k) {
    fetch(lower + 9 * ahead, 2);
    for (int i = schedule_.first_later[at(k)]; i < schedule_.first_later[at(k) + 1]; ++i, ++later, lower += 9)
      subtract_product((*later < schedule_.eliminated() ? w : shifted) + 3 * std::ptrdiff_t{*later}, lower,
                       w + 3 * std::ptrdiff_t{k});
  }
}

template <bool symmetric>
void Elimination::backward_uniform(double* w, const double* kept) {
  const double* const shifted = kept - 3 * std::ptrdiff_t{schedule_.eliminated()};
  const double* const coupling = values_.data() + (symmetric ? schedule_.lower_values : schedule_.upper_values);
  for (int k = schedule_.eliminated() - 1; k >= 0; --k) {
    const double* const pivot = values_.data() + 9 * std::ptrdiff_t{k};
    double* const own = w + 3 * std::ptrdiff_t{k};
    fetch(pivot - 9 * ahead, 2);
    fetch(coupling + 9 * (schedule_.first_later[at(k)] - ahead), 2);
    if constexpr (symmetric) divide_left(own, pivot);
    for (std::ptrdiff_t i = schedule_.first_later[at(k)]; i < schedule_.first_later[at(k) + 1]; ++i) {
      const int j = schedule_.later[at(i)];
      const double* const later = (j < schedule_.eliminated() ? w : shifted) + 3 * std::ptrdiff_t{j};
      if constexpr (symmetric)
        subtract_transposed_product(own, coupling + 9 * i, later);
      else
        subtract_product(own, coupling + 9 * i, later);
    }
    if constexpr (!symmetric) divide_left(own, pivot);
  }
}

void Elimination::forward(double* w, double* kept) {
  schedule_.uniform ? forward_uniform(w, kept) : forward_mixed(w, kept);
}

void Elimination::backward(double* w, const double* kept) {
  if (!schedule_.uniform) return backward_mixed(w, kept);
  schedule_.symmetric ? backward_uniform<true>(w, kept) : backward_uniform<false>(w, kept);
}

}   // namespace cablenet::elimination
