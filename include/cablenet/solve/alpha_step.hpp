#pragma once
#include <petscts.h>

namespace cablenet::solve {

/// The generalised-alpha method's parameters and the step [s], as TSALPHA2 has them now.
struct AlphaStep {
  double alpha_m, alpha_f, gamma, beta, dt;

  /// TSALPHA2 estimates its first acceleration with parameters of their own.
  bool is_start() const { return alpha_m == 1 && alpha_f == 1 && gamma == 1 && beta == 0.5; }
  /// At spectral radius 1 TSALPHA2's acceleration alternates about the truth.
  bool alternates() const { return alpha_m == 0.5 && alpha_f == 0.5; }
  /// How v and a follow x at the stage [1/s, 1/s^2].
  double shift_v() const { return gamma / (beta * dt); }
  double shift_a() const { return alpha_m / (alpha_f * beta * dt * dt); }
};

AlphaStep read_alpha_step(TS ts);

}   // namespace cablenet::solve
