#pragma once

namespace cablenet::solve {

/// Decides whether the next Newton correction needs a new tangent or can use the last one and its factors.  A tangent
/// is kept only where factors are dear, and only as long as corrections with it serve: as long as they bring the
/// residual down well.  It is kept over the end of a step if every correction of that step served; a tangent from
/// farther back could lead Newton's method to another solution.  Tests: tests/parallel/tangent_reuse_test.cpp
class TangentReuse {
public:
  TangentReuse() = default;
  /// @param keeps  whether tangents may be kept at all: factors are dear, many times a solve
  explicit TangentReuse(bool keeps) : keeps_(keeps) {}

  /// Before each Newton solve.
  /// @param key      what the tangent depends on besides the state: the step [s].  A solve with another key, or with
  ///                 one <= 0, starts with a new tangent
  /// @param careful  each correction needs a new tangent
  void begin_solve(double key, bool careful);
  /// Before each correction.
  bool wants_new() const { return wants_new_; }
  /// A new tangent was computed.
  void note_computed();
  /// After each correction.
  /// @param iteration    corrections so far in this solve
  /// @param contraction  the residual's norm after the correction over that before it
  void note_correction(int iteration, double contraction);
  /// The last correction used a tangent older than itself.  @pre note_correction has not been called since
  bool was_kept() const { return !is_new_; }
  bool computes_always() const { return !keeps_; }

private:
  bool keeps_ = false;
  bool wants_new_ = true;
  bool is_careful_ = false;
  bool new_ones_served_ = false;    ///< in this solve, every correction by a new tangent
  bool kept_ones_served_ = false;   ///< in this solve, every correction by a kept one
  bool is_trusted_ = false;         ///< new tangents served in the last solve
  int good_in_row_ = 0;
  bool is_new_ = false;
  double key_ = 0;
};

}   // namespace cablenet::solve
