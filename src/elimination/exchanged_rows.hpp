#pragma once
#include <cmath>
#include <limits>
#include <utility>

#include "cablenet/elimination/elimination.hpp"

/// Operations on row-major pivot blocks of any size, which are factored with row exchanges.  A body's pivot needs them:
/// its unknowns have different units, and its diagonal need not be positive.
namespace cablenet::elimination {

/// The largest absolute value of each column.
template <class N>
void column_sizes(const double* a, double* size, N n) {
  for (int c = 0; c < n; ++c) size[c] = 0;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) size[c] = std::fabs(a[r * n + c]) > size[c] ? std::fabs(a[r * n + c]) : size[c];
}

/// Factors A in place: P A = L U with unit L.  The reciprocals of the pivots stand on the diagonal.  A pivot is
/// compared with the largest entry of its column, because a body's unknowns have different units.
/// @param origin  gets the row of A that became row k
/// @returns false if A is singular to rounding
template <class N>
bool factor_block(double* a, int* origin, N n) {
  double size[largest_block];
  column_sizes(a, size, n);
  for (int r = 0; r < n; ++r) origin[r] = r;
  for (int k = 0; k < n; ++k) {
    int best = k;
    for (int r = k + 1; r < n; ++r) best = std::fabs(a[r * n + k]) > std::fabs(a[best * n + k]) ? r : best;
    const double pivot = a[best * n + k];
    // The negated comparison makes nan count as zero.
    if (!(std::fabs(pivot) > std::numeric_limits<double>::epsilon() * size[k])) return false;
    if (best != k) {
      std::swap(origin[k], origin[best]);
      for (int c = 0; c < n; ++c) std::swap(a[k * n + c], a[best * n + c]);
    }
    a[k * n + k] = 1 / pivot;
    for (int r = k + 1; r < n; ++r) {
      const double factor = a[r * n + k] *= a[k * n + k];
      for (int c = k + 1; c < n; ++c) a[r * n + c] -= factor * a[k * n + c];
    }
  }
  return true;
}

/// Replaces each row w by w A^-1, all rows at a time.
template <class Rows, class N>
void divide_right(double* w, const double* lu, const int* origin, Rows rows, N n) {
  double y[largest_block][largest_block];
  const auto subtract = [&](int c, int k) {
    for (int r = 0; r < rows; ++r) y[c][r] -= y[k][r] * lu[k * n + c];
  };
  for (int c = 0; c < n; ++c) {
    for (int r = 0; r < rows; ++r) y[c][r] = w[r * n + c];
    for (int k = 0; k < c; ++k) subtract(c, k);
    for (int r = 0; r < rows; ++r) y[c][r] *= lu[c * n + c];
  }
  for (int c = n - 1; c >= 0; --c) {
    for (int k = n - 1; k > c; --k) subtract(c, k);
    for (int r = 0; r < rows; ++r) w[r * n + origin[c]] = y[c][r];
  }
}

/// Replaces w by A^-1 w.
template <class N>
void divide_left(double* w, const double* lu, const int* origin, N n) {
  double y[largest_block];
  for (int r = 0; r < n; ++r) {
    y[r] = w[origin[r]];
    for (int k = 0; k < r; ++k) y[r] -= lu[r * n + k] * y[k];
  }
  for (int r = n - 1; r >= 0; --r) {
    for (int k = n - 1; k > r; --k) y[r] -= lu[r * n + k] * y[k];
    w[r] = y[r] *= lu[r * n + r];
  }
}

}   // namespace cablenet::elimination
