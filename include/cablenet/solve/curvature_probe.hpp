#pragma once
#include "cablenet/base/archive.hpp"
#include "cablenet/system/assembler.hpp"

namespace cablenet::solve {

/// Shows how fast Newton's method converges where rounding hides it.  With small steps the first correction brings the
/// residual down to rounding.  Whether it left an error below rounding cannot be seen, and a second correction would be
/// needed in each step to be sure.  A solve whose first guess is moved farther off, along what the last one was off,
/// leaves an error that is the square of that factor larger.  If that does not show either, one correction is enough
/// in the next steps.
///
/// All member functions are collective.  Tests: tests/parallel/tangent_reuse_test.cpp
class CurvatureProbe {
public:
  /// A guess is moved by so many times what the last one was off.
  static constexpr double moved = 30;

  /// @param scratch  a vector of the unknowns
  explicit CurvatureProbe(system::Vector scratch) : guess_(std::move(scratch)) {}

  /// Where the user says when Newton's method ends, no guess is moved.
  void turn_off() { is_on_ = false; }
  /// At a solve's first guess [m] of the end of a step of length dt [s] from x0 [m].  Moves the guess now and then.
  void begin_solve(double dt, Vec x0, Vec guess);
  /// After a step.
  /// @param was_in_doubt  NewtonConvergence::was_in_doubt() of its last solve
  void end_solve(bool was_in_doubt);
  /// The error of the running solve's guess, over what it would be had the guess not been moved.
  double farther() const { return is_probing_ ? 1 + moved : 1; }
  /// What is known of the last guess is void.
  void forget();
  void archive(Archive& archive);

private:
  system::Vector guess_;   ///< of the last solve, where it was kept
  double dt_ = 0;          ///< of that solve [s]; 0: none was kept
  bool is_on_ = true;
  bool is_probing_ = false;
  int doubts_ = 0;     ///< solves in a row that were in doubt
  int patience_ = 2;   ///< so many of them before a guess is moved
};

/// Whether a guess may be moved.  It may be too far for a stiff link between a cable and a body, whose rounding also
/// hides what the others leave.  Collective.
bool suits_probes(const system::Assembler& assembler);

}   // namespace cablenet::solve
