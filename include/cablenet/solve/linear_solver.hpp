#pragma once
#include <petscksp.h>

#include <memory>
#include <optional>
#include <string>

#include "cablenet/solve/network_pc.hpp"

namespace cablenet::solve {

/// Chooses what solves the linear systems of a network and tells why.  The default is the network elimination, applied
/// once.  Where its symbolic pass predicts more than -cable_elimination_limit block products a node, as for large nets,
/// MUMPS takes over.  It chooses its ordering itself: METIS for large matrices, or what it has instead.  Whatever the
/// user's -ksp_* and -pc_* options say wins. All member functions are collective.
class LinearSolver {
public:
  LinearSolver() = default;
  /// Sets the KSP up and reads its options, with its prefix.
  /// @param ksp     must outlive this
  /// @param matrix  AIJ unless the user chose another type, which gets PETSc's LU
  /// @throws InputError if -cable_elimination_limit is negative
  LinearSolver(KSP ksp, const partition::LocalNetwork& network, Mat matrix);

  /// Factoring costs many times as much as a solve, as it does for nets.
  bool factors_are_dear() const { return factors_are_dear_; }
  /// What the last factorisation met; nothing where the elimination is not used.
  std::optional<PivotReport> pivots() const;
  /// Solves with another matrix of the same kind, by a KSP of its own around the same preconditioner.  What SNES hangs
  /// on its KSP (-snes_ksp_ew) asks for a residual of SNES, which there is not yet.
  KSPConvergedReason solve_outside_newton(Mat matrix, Vec right, Vec solution);
  /// After a failure: PETSc would not try to factor another matrix after some.
  void recover();
  /// "preonly + lu (mumps), reason": what the KSP really is.
  std::string describe() const;

private:
  void use_elimination_or_mumps(const partition::LocalNetwork& network, PC pc);

  KSP ksp_ = nullptr;
  Mat matrix_ = nullptr;
  std::unique_ptr<NetworkPc> elimination_;   ///< where the KSP uses it
  bool factors_are_dear_ = false;
  std::string reason_;   ///< "12.4 block products a node"
};

}   // namespace cablenet::solve
