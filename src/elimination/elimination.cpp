#include "cablenet/elimination/elimination.hpp"

#include <algorithm>
#include <utility>

#include "uniform_kernels.hpp"

namespace cablenet::elimination {
namespace {

/// An elimination fetches values so many nodes of a chain ahead, because it reads more streams of memory than a
/// processor follows by itself.
constexpr std::ptrdiff_t ahead = 20;

void fetch(const double* values, int lines) {
  for (std::ptrdiff_t i = 0; i < lines; ++i) __builtin_prefetch(values + 8 * i);
}

}   // namespace

Elimination::Elimination(Plan plan, const std::function<BlockSource(int, int)>& where) : plan_(std::move(plan)) {
  sources_.reserve(plan_.touched.size());
  int most_later = 0;
  for (int k = 0; k < plan_.eliminated(); ++k) {
    const int begin = plan_.first_later[at(k)], end = plan_.first_later[at(k) + 1];
    add_source(where(k, k));
    for (int i = begin; i < end; ++i) {
      if (!plan_.symmetric) add_source(where(k, plan_.later[at(i)]));
      add_source(where(plan_.later[at(i)], k));
    }
    most_later = std::max(most_later, end - begin);
  }
  std::vector<bool>().swap(plan_.touched);
  values_.resize(at(plan_.values));
  column_.resize(9 * at(most_later));
  if (!plan_.uniform) prepare_mixed();
}

void Elimination::add_source(BlockSource source) {
  source.touched = plan_.touched[sources_.size()];
  sources_.push_back(source);
}

template <class Run, class Step>
void Elimination::visit_forward(Run&& run, Step&& step) const {
  int begin = 0;
  for (const Large& large : large_) {
    if (!run(begin, large.block) || !step(large)) return;
    begin = large.block + 1;
  }
  run(begin, plan_.eliminated());
}

template <class Run, class Step>
void Elimination::visit_backward(Run&& run, Step&& step) const {
  int end = plan_.eliminated();
  for (auto large = large_.rbegin(); large != large_.rend(); ++large) {
    run(large->block + 1, end);
    step(*large);
    end = large->block;
  }
  run(0, end);
}

Pivots Elimination::factor(const Arrays& arrays) {
  std::fill(values_.begin() + plan_.kept_values, values_.end(), 0.0);
  Pivots pivots;
  const std::int64_t* target = plan_.targets.data();
  const auto run = [&](int begin, int end) {
    const int reached = plan_.symmetric ? factor_run<true>(begin, end, arrays, target, pivots.negative)
                                        : factor_run<false>(begin, end, arrays, target, pivots.negative);
    if (reached < end) pivots.singular = reached;
    return reached == end;
  };
  const auto step = [&](const Large& large) {
    const int negative = factor_large(large, arrays, target);
    if (negative < 0) pivots.singular = large.block;
    if (negative > 0) pivots.negative += negative;
    return negative >= 0;
  };
  visit_forward(run, step);
  return pivots;
}

template <bool symmetric>
int Elimination::factor_run(int begin, int end, const Arrays& arrays, const std::int64_t*& next_target,
                            int& all_negative) {
  double* const values = values_.data();
  const int couplings = plan_.first_later[at(begin)];
  double* pivot = values + plan_.pivot(begin);
  double* lower = values + plan_.lower_values + plan_.coupling(couplings);
  double* upper = symmetric ? column_.data() : values + plan_.upper_values + plan_.coupling(couplings);
  const std::int64_t* target = next_target;
  const BlockSource* source = sources_.data() + begin + (symmetric ? 1 : 2) * std::ptrdiff_t{couplings};
  int k = begin;
  for (; k < end; ++k, pivot += 9) {
    const int count = plan_.first_later[at(k) + 1] - plan_.first_later[at(k)];
    fetch(arrays[source->array] + source->offset + 27 * ahead, 4);
    for (const double* to : {pivot, lower, upper}) fetch(to + 9 * ahead, 1);
    load_block(pivot, *source++, arrays);
    const int negative = factor_block(pivot);
    if (negative < 0) break;
    all_negative += negative;
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
  next_target = target;
  return k;
}

template <bool mixed>
void Elimination::forward_run(int begin, int end, const Joined<double>& x) {
  const int* first = plan_.first_later.data();
  const double* lower = values_.data() + plan_.lower_values + plan_.coupling(first[begin]);
  const int* later = plan_.later.data() + first[begin];
  const double* own = x.eliminated + unknown<mixed>(begin);
  for (int k = begin; k < end; ++k, own += 3) {
    fetch(lower + 9 * ahead, 2);
    for (int i = first[k]; i < first[k + 1]; ++i, ++later, lower += 9)
      subtract_product(x.at(unknown<mixed>(*later)), lower, own);
  }
}

template <bool symmetric, bool mixed>
void Elimination::backward_run(int begin, int end, double* w, const Joined<const double>& x) {
  const int* const first = plan_.first_later.data();
  const std::int64_t regions = symmetric ? plan_.lower_values : plan_.upper_values;
  const double* const coupling = values_.data() + regions + plan_.coupling(first[begin]);
  const double* pivot = values_.data() + plan_.pivot(begin) + 9 * std::ptrdiff_t{end - begin};
  double* own = w + unknown<mixed>(begin) + 3 * std::ptrdiff_t{end - begin};
  for (int k = end - 1; k >= begin; --k) {
    pivot -= 9;
    own -= 3;
    fetch(pivot - 9 * ahead, 2);
    fetch(coupling + 9 * (first[k] - first[begin] - ahead), 2);
    if constexpr (symmetric) divide_left(own, pivot);
    for (std::ptrdiff_t i = first[k]; i < first[k + 1]; ++i) {
      const double* const later = x.at(unknown<mixed>(plan_.later[at(i)]));
      const double* const block = coupling + 9 * (i - first[begin]);
      if constexpr (symmetric)
        subtract_transposed_product(own, block, later);
      else
        subtract_product(own, block, later);
    }
    if constexpr (!symmetric) divide_left(own, pivot);
  }
}

std::ptrdiff_t Elimination::unknowns() const {
  return plan_.uniform ? unknown<false>(plan_.eliminated()) : unknown<true>(plan_.eliminated());
}

void Elimination::forward(double* w, double* kept) {
  const Joined<double> x{w, kept, unknowns()};
  const auto run = [&](int begin, int end) {
    plan_.uniform ? forward_run<false>(begin, end, x) : forward_run<true>(begin, end, x);
    return true;
  };
  const auto step = [&](const Large& large) {
    forward_large(large, x);
    return true;
  };
  visit_forward(run, step);
}

void Elimination::backward(double* w, const double* kept) {
  const Joined<const double> x{w, kept, unknowns()};
  const auto run = [&](int begin, int end) {
    if (!plan_.uniform) return backward_run<false, true>(begin, end, w, x);
    plan_.symmetric ? backward_run<true, false>(begin, end, w, x) : backward_run<false, false>(begin, end, w, x);
  };
  visit_backward(run, [&](const Large& large) { backward_large(large, w, x); });
}

}   // namespace cablenet::elimination
