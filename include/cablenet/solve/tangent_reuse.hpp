#pragma once
#include <petscsnes.h>

namespace cablenet::solve {

/// Keeps a tangent, and its factors, over Newton iterations for as long as they serve, where factors are dear; over
/// steps, too, after one in which all of them did, lest Newton start off towards another solution.  Does nothing where
/// -snes_lag_jacobian is given.  Tests: tests/parallel/tangent_reuse_test.cpp
class TangentReuse {
public:
  TangentReuse() = default;
  /// @param worthwhile  factoring costs many times a solve
  TangentReuse(SNES snes, bool worthwhile);

  /// Before each Newton solve.  @param key  what else the tangent depends on, > 0: another asks for a new one
  /// @param careful  compute it in every iteration
  void begin_solve(double key, bool careful);
  /// After a correction.
  /// @param contraction  of the residual by it
  void note_correction(int iteration, double contraction);
  void note_computed() { is_new_ = true; }
  /// The last correction used a tangent from before the one before it.
  bool was_kept() const { return was_kept_; }
  /// Every iteration computes the tangent anew.
  bool computes_always() const { return computes_always_; }

private:
  void refresh();

  SNES snes_ = nullptr;
  bool is_active_ = false;
  bool is_careful_ = false;
  bool is_calm_ = false;   ///< every correction of the last solve served
  bool computes_always_ = true;
  bool is_new_ = false;
  bool was_kept_ = false;
  double key_ = 0;
};

}   // namespace cablenet::solve
