#pragma once

namespace cablenet::solve {

/// The generalised-alpha method's weights.  A step of length dt leads from (x0, v0, a0) to (x1, v1, a1):
///   x1 = x0 + dt v0 + dt^2 ((1/2 - beta) a0 + beta a1),  v1 = v0 + dt ((1 - gamma) a0 + gamma a1)
/// The equations of motion hold at the stage:
///   x0 + alpha_f (x1 - x0),  v0 + alpha_f (v1 - v0),  a0 + alpha_m (a1 - a0)
/// Source: Chung & Hulbert, J. Appl. Mech. 60 (1993) 371, whose alphas are 1 minus these.
struct AlphaWeights {
  double alpha_m, alpha_f, gamma, beta;

  /// These are the weights of the two steps by which PETSc's TSALPHA2 estimates its first acceleration.
  bool is_start() const { return alpha_m == 1 && alpha_f == 1 && gamma == 1 && beta == 0.5; }
  /// The stage is the middle of the step.  The acceleration there is the step's mean (v1 - v0)/dt.  The method's own
  /// acceleration, at the step's end, alternates about the true one from step to step.  At spectral radius 1 that never
  /// ends.
  bool is_centred() const { return alpha_f == 0.5 && alpha_m == gamma; }
  /// The s in a centred method's x1 = x0 + dt v0 + dt^2/2 (s m + (1 - s) a0), where m is the step's mean acceleration.
  /// It is 1 at spectral radius 1.
  double share_of_mean() const { return 2 * beta / alpha_m; }
};

/// The weights and the length of a step.
struct AlphaStep : AlphaWeights {
  double dt;   ///< [s]

  /// How fast v and a at the stage change with x at the stage: dv/dx [1/s] and da/dx [1/s^2].
  double shift_v() const { return gamma / (beta * dt); }
  double shift_a() const { return alpha_m / (alpha_f * beta * dt * dt); }
};

}   // namespace cablenet::solve
