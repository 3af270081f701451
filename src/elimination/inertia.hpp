#pragma once
#include <cmath>
#include <limits>
#include <utility>

#include "cablenet/elimination/elimination.hpp"

/// How many eigenvalues of a symmetric block are negative.  Factors with row exchanges do not tell, and those without
/// need not exist.  L D L^T with exchanges of rows and columns alike, and with blocks of 1x1 and 2x2 in D, always does,
/// and D has as many negative eigenvalues as the block.
/// Source: Bunch & Parlett, SIAM J. Numer. Anal. 8 (1971) 639.  Tests: tests/unit/elimination_test.cpp
namespace cablenet::elimination {

/// The symmetric part of a row-major block, scaled alike in rows and columns, as a body's unknowns have different
/// units.
template <class N>
void symmetrise(const double* a, double (*s)[largest_block], N n) {
  double scale[largest_block];
  for (int i = 0; i < n; ++i) {
    double size = 0;
    for (int j = 0; j < n; ++j) size = std::fmax(size, std::fabs(s[i][j] = 0.5 * (a[i * n + j] + a[j * n + i])));
    scale[i] = size > 0 ? 1 / std::sqrt(size) : 1;
  }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) s[i][j] *= scale[i] * scale[j];
}

/// Exchanges rows and columns i and j of the n x n matrix s.
inline void exchange(double (*s)[largest_block], int n, int i, int j) {
  if (i == j) return;
  for (int k = 0; k < n; ++k) std::swap(s[i][k], s[j][k]);
  for (int k = 0; k < n; ++k) std::swap(s[k][i], s[k][j]);
}

/// Where the largest entry of the rows and columns from k on stands, and the largest one of their diagonal.
struct Largest {
  int row, column, diagonal;
};
inline Largest find_largest(const double (*s)[largest_block], int n, int k) {
  Largest at{k, k, k};
  for (int i = k; i < n; ++i) {
    if (std::fabs(s[i][i]) > std::fabs(s[at.diagonal][at.diagonal])) at.diagonal = i;
    for (int j = i; j < n; ++j)
      if (std::fabs(s[i][j]) > std::fabs(s[at.row][at.column])) at.row = i, at.column = j;
  }
  return at;
}

/// @returns the number of negative eigenvalues of the symmetric part of a row-major block; those that are zero to
/// rounding do not count
template <class N>
int negative_eigenvalues(const double* a, N n) {
  constexpr double growth = 0.6404;   // (1 + sqrt(17))/8 bounds the growth of entries best
  double s[largest_block][largest_block];
  symmetrise(a, s, n);
  int negative = 0;
  for (int k = 0; k < n;) {
    const auto [row, column, diagonal] = find_largest(s, n, k);
    const double largest = std::fabs(s[row][column]);
    // The negated comparison ends at nan, too.
    if (!(largest > n * std::numeric_limits<double>::epsilon())) break;
    if (std::fabs(s[diagonal][diagonal]) >= growth * largest) {
      exchange(s, n, k, diagonal);
      negative += s[k][k] < 0;
      for (int i = k + 1; i < n; ++i)
        for (int j = k + 1; j < n; ++j) s[i][j] -= s[i][k] * s[k][j] / s[k][k];
      k += 1;
      continue;
    }
    // The determinant of such a 2x2 block is negative.
    exchange(s, n, k, row);
    exchange(s, n, k + 1, column);
    negative += 1;
    const double p = s[k][k], q = s[k + 1][k + 1], b = s[k][k + 1], determinant = p * q - b * b;
    for (int i = k + 2; i < n; ++i) {
      const double x = (q * s[i][k] - b * s[i][k + 1]) / determinant, y = (p * s[i][k + 1] - b * s[i][k]) / determinant;
      for (int j = k + 2; j < n; ++j) s[i][j] -= x * s[k][j] + y * s[k + 1][j];
    }
    k += 2;
  }
  return negative;
}

}   // namespace cablenet::elimination
