#pragma once
#include <type_traits>

#include "cablenet/elimination/elimination.hpp"

/// Operations on row-major blocks of any size.  A size is an int, or a Size<n> where the compiler should know it.
namespace cablenet::elimination {

template <int n>
using Size = std::integral_constant<int, n>;

/// Calls visit(size), where the sizes that nodes and bodies have are passed as Size<n>.
template <class Visit>
void with_size(int size, Visit&& visit) {
  switch (size) {
    case 3:
      return visit(Size<3>{});
    case 6:
      return visit(Size<6>{});
    case 7:
      return visit(Size<7>{});
    default:
      return visit(size);
  }
}

template <class Rows, class Columns>
void load_block(double* block, const BlockSource& source, const Arrays& arrays, Rows rows, Columns columns) {
  if (source.absent) return;
  const double* from = arrays[source.array] + source.offset;
  const std::ptrdiff_t stride = source.stride;
  const auto load = [&](auto&& entry) {
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c)
        block[r * columns + c] = source.touched ? block[r * columns + c] + entry(r, c) : entry(r, c);
  };
  if (source.transposed)
    load([&](int r, int c) { return from[c * stride + r]; });
  else
    load([&](int r, int c) { return from[r * stride + c]; });
}

/// target -= a b, or target = -a b where `first`.
template <class Rows, class Inner, class Columns>
void update_block(double* target, bool first, const double* a, const double* b, Rows rows, Inner inner,
                  Columns columns) {
  for (int r = 0; r < rows; ++r, target += columns, a += inner) {
    double sum[largest_block];
    for (int c = 0; c < columns; ++c) sum[c] = first ? 0 : target[c];
    for (int k = 0; k < inner; ++k)
      for (int c = 0; c < columns; ++c) sum[c] -= a[k] * b[k * columns + c];
    for (int c = 0; c < columns; ++c) target[c] = sum[c];
  }
}

/// y -= a x.
template <class Rows, class Columns>
void subtract_product(double* y, const double* a, const double* x, Rows rows, Columns columns) {
  for (int r = 0; r < rows; ++r, a += columns)
    for (int c = 0; c < columns; ++c) y[r] -= a[c] * x[c];
}

}   // namespace cablenet::elimination
