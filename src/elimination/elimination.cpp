#include "cablenet/elimination/elimination.hpp"

#include <algorithm>
#include <utility>

#include "uniform_kernels.hpp"

namespace cablenet::elimination {
namespace {

std::size_t at(std::int64_t index) { return static_cast<std::size_t>(index); }

/// `first`: nothing has been added to the target yet.
void apply_update(double* values, std::int64_t target, const double* a, const double* b) {
  update_block(values + (target < 0 ? ~target : target), target < 0, a, b);
}

}   // namespace

Elimination::Elimination(Schedule schedule, const std::function<BlockSource(int, int)>& where)
    : schedule_(std::move(schedule)) {
  sources_.reserve(schedule_.touched.size());
  int most_later = 0;
  for (int k = 0; k < schedule_.eliminated(); ++k) {
    sources_.push_back(where(k, k));
    for (int i = schedule_.nodes[at(k)].first_later; i < schedule_.nodes[at(k) + 1].first_later; ++i) {
      if (!schedule_.symmetric) sources_.push_back(where(k, schedule_.later[at(i)]));
      sources_.push_back(where(schedule_.later[at(i)], k));
    }
    most_later = std::max(most_later, schedule_.nodes[at(k) + 1].first_later - schedule_.nodes[at(k)].first_later);
  }
  values_.resize(at(schedule_.values));
  column_.resize(9 * at(most_later));
  if (!schedule_.uniform) prepare_mixed();
}

Pivots Elimination::factor(const Arrays& arrays) {
  std::fill(values_.begin() + schedule_.kept_values, values_.end(), 0.0);
  if (!schedule_.uniform) return factor_mixed(arrays);
  return schedule_.symmetric ? factor_uniform<true>(arrays) : factor_uniform<false>(arrays);
}

template <bool symmetric>
Pivots Elimination::factor_uniform(const Arrays& arrays) {
  Pivots pivots;
  const std::int64_t* target = schedule_.targets.data();
  double* block = values_.data();
  std::size_t number = 0;
  const auto load = [&](double* to) {
    load_block(to, sources_[number], schedule_.touched[number], arrays);
    ++number;
  };
  for (int k = 0; k < schedule_.eliminated(); ++k) {
    const int count = schedule_.nodes[at(k) + 1].first_later - schedule_.nodes[at(k)].first_later;
    double* const pivot = block;
    load(pivot);
    const int negative = factor_block(pivot);
    if (negative < 0) return {k, pivots.negative, pivots.first_negative};
    if (negative > 0 && pivots.negative == 0) pivots.first_negative = k;
    pivots.negative += negative;
    block += 9;
    double* const rows = block;
    for (int i = 0; i < count; ++i, block += 9) {
      if constexpr (!symmetric) load(block), block += 9;
      load(block);
      if constexpr (symmetric) transpose_block(column_.data() + 9 * i, block);
      divide_right(block, pivot);
    }
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < (symmetric ? i + 1 : count); ++j)
        if constexpr (symmetric)
          apply_update(values_.data(), *target++, rows + 9 * i, column_.data() + 9 * j);
        else
          apply_update(values_.data(), *target++, rows + 18 * i + 9, rows + 18 * j);
  }
  return pivots;
}

template <bool symmetric>
void Elimination::forward_uniform(double* w) {
  const double* block = values_.data();
  for (int k = 0; k < schedule_.eliminated(); ++k) {
    block += 9;
    for (int i = schedule_.nodes[at(k)].first_later; i < schedule_.nodes[at(k) + 1].first_later; ++i, block += 9) {
      if constexpr (!symmetric) block += 9;
      subtract_product(w + 3 * schedule_.later[at(i)], block, w + 3 * k);
    }
  }
}

template <bool symmetric>
void Elimination::backward_uniform(double* w) {
  constexpr int width = symmetric ? 9 : 18;
  for (int k = schedule_.eliminated() - 1; k >= 0; --k) {
    const double* const pivot = values_.data() + schedule_.nodes[at(k)].values;
    const double* block = pivot + 9;
    double* const own = w + 3 * k;
    if constexpr (symmetric) divide_left(own, pivot);
    for (int i = schedule_.nodes[at(k)].first_later; i < schedule_.nodes[at(k) + 1].first_later; ++i, block += width) {
      const double* later = w + 3 * schedule_.later[at(i)];
      if constexpr (symmetric)
        subtract_transposed_product(own, block, later);
      else
        subtract_product(own, block, later);
    }
    if constexpr (!symmetric) divide_left(own, pivot);
  }
}

void Elimination::forward(double* w) {
  if (!schedule_.uniform) return forward_mixed(w);
  schedule_.symmetric ? forward_uniform<true>(w) : forward_uniform<false>(w);
}

void Elimination::backward(double* w) {
  if (!schedule_.uniform) return backward_mixed(w);
  schedule_.symmetric ? backward_uniform<true>(w) : backward_uniform<false>(w);
}

}   // namespace cablenet::elimination
