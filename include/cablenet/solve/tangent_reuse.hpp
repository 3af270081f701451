#pragma once
#include <petscsnes.h>

namespace cablenet::solve {

/// Keeps a tangent, and its factors, over Newton iterations for as long as they serve, where factors are dear; over
/// steps, too, after one in which all of them did, lest Newton start off towards another solution.  Does nothing where
/// -snes_lag_jacobian or -snes_lag_jacobian_persists is given.  Tests: tests/parallel/tangent_reuse_test.cpp
class TangentReuse {
public:
  TangentReuse() = default;
  /// @param worthwhile  factoring costs many times a solve
  TangentReuse(SNES snes, bool worthwhile);

  /// Before each Newton solve.  @param key  what else the tangent depends on; another asks for a new one, and so does
  /// any <= 0
  /// @param careful  compute it in every iteration
  void begin_solve(double key, bool careful);
  /// After a correction.
  /// @param contraction  of the residual by it
  void note_correction(int iteration, double contraction);
  void note_computed() { is_new_ = true; }
  /// The correction that was made last used the tangent of the one before it.  @pre note_correction comes after
  bool was_kept() const { return !is_new_; }
  /// Every iteration computes the tangent anew.
  bool computes_always() const { return computes_always_; }

private:
  void refresh();

  SNES snes_ = nullptr;
  bool is_active_ = false;
  bool is_careful_ = false;
  bool new_ones_served_ = false;    ///< in this solve, every correction by a new tangent
  bool kept_ones_served_ = false;   ///< in this solve, every correction by a kept one
  bool is_trusted_ = false;         ///< new tangents served in the last solve
  int good_in_row_ = 0;
  bool computes_always_ = true;
  bool is_new_ = false;
  double key_ = 0;
};

}   // namespace cablenet::solve
