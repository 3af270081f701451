#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "cablenet/elimination/elimination.hpp"

/// Operations on row-major 3x3 blocks.
namespace cablenet::elimination {

inline void load_row(double* row, const double* from, bool touched) {
  row[0] = touched ? row[0] + from[0] : from[0];
  row[1] = touched ? row[1] + from[1] : from[1];
  row[2] = touched ? row[2] + from[2] : from[2];
}

inline void load_block(double* block, const BlockSource& source, const Arrays& arrays) {
  if (source.absent) return;
  const double* from = arrays[source.array] + source.offset;
  const std::size_t stride = source.stride;
  if (source.transposed) {
    for (std::size_t r = 0; r < 3; ++r) {
      const double row[3] = {from[r], from[stride + r], from[2 * stride + r]};
      load_row(block + 3 * r, row, source.touched);
    }
    return;
  }
  load_row(block, from, source.touched);
  load_row(block + 3, from + stride, source.touched);
  load_row(block + 6, from + 2 * stride, source.touched);
}

/// Factors A in place: A = L U with unit L.  The reciprocals of the pivots stand on the diagonal.
/// @returns the number of negative pivots, or -1 if one of them is zero to rounding
inline int factor_block(double* a) {
  const double largest = std::max({std::fabs(a[0]), std::fabs(a[4]), std::fabs(a[8])});
  const double least = std::numeric_limits<double>::epsilon() * largest;
  const double p0 = a[0];
  a[0] = 1 / p0;
  a[3] *= a[0];
  a[6] *= a[0];
  const double p1 = a[4] - a[3] * a[1];
  a[4] = 1 / p1;
  a[5] -= a[3] * a[2];
  a[7] = (a[7] - a[6] * a[1]) * a[4];
  const double p2 = a[8] - a[6] * a[2] - a[7] * a[5];
  a[8] = 1 / p2;
  // These comparisons are false for nan, which thus counts as zero.
  const bool regular = std::fabs(p0) > least && std::fabs(p1) > least && std::fabs(p2) > least;
  return regular ? (p0 < 0) + (p1 < 0) + (p2 < 0) : -1;
}

/// Replaces each row w by w D^-1.
inline void divide_right(double* rows, const double* d, int count = 3) {
  for (int r = 0; r < count; ++r, rows += 3) {
    const double w0 = rows[0] * d[0];
    const double w1 = (rows[1] - w0 * d[1]) * d[4];
    const double w2 = (rows[2] - w0 * d[2] - w1 * d[5]) * d[8];
    rows[2] = w2;
    rows[1] = w1 - w2 * d[7];
    rows[0] = w0 - rows[1] * d[3] - w2 * d[6];
  }
}

/// Replaces w by D^-1 w.
inline void divide_left(double* w, const double* d) {
  const double y1 = w[1] - d[3] * w[0];
  const double y2 = w[2] - d[6] * w[0] - d[7] * y1;
  w[2] = y2 * d[8];
  w[1] = (y1 - d[5] * w[2]) * d[4];
  w[0] = (w[0] - d[1] * w[1] - d[2] * w[2]) * d[0];
}

/// target -= a b, or target = -a b where `first`.
inline void update_block(double* target, bool first, const double* a, const double* b) {
  for (int r = 0; r < 9; r += 3)
    for (int c = 0; c < 3; ++c) {
      const double product = a[r] * b[c] + a[r + 1] * b[3 + c] + a[r + 2] * b[6 + c];
      target[r + c] = (first ? 0 : target[r + c]) - product;
    }
}

inline void transpose_block(double* out, const double* a) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) out[3 * r + c] = a[3 * c + r];
}

/// y -= a x.
inline void subtract_product(double* y, const double* a, const double* x) {
  for (int r = 0; r < 3; ++r) y[r] -= a[3 * r] * x[0] + a[3 * r + 1] * x[1] + a[3 * r + 2] * x[2];
}

/// y -= a^T x.
inline void subtract_transposed_product(double* y, const double* a, const double* x) {
  for (int c = 0; c < 3; ++c) y[c] -= a[c] * x[0] + a[3 + c] * x[1] + a[6 + c] * x[2];
}

}   // namespace cablenet::elimination
