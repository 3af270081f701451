#pragma once

namespace cablenet::system {

/// Energies and work [J], and what has been taken out of them since the start, positive where it was taken.
struct Energies {
  double kinetic = 0;
  double strain = 0;
  double gravity = 0;      ///< m g z
  double work = 0;         ///< by moved points, forces and torques since the start
  double dissipated = 0;   ///< by the step's formulas: what they take from stored energy beside the forces' work
  double damping = 0;      ///< by axial and mass damping of the cables
  double water = 0;
  double bed = 0;
  double start = 0;   ///< total() at the start, where accounts are kept

  double total() const { return kinetic + strain + gravity - work; }
  double taken() const { return dissipated + damping + water + bed; }
  /// Zero where all is accounted for.
  double balance() const { return total() + taken() - start; }
};

/// Of a run so far, on all ranks together.  [J]
struct EnergySummary {
  Energies now;
  double moved = 0;       ///< the largest kinetic energy, or change of one other energy or account, since the start
  double gained = 0;      ///< by the step's formulas: how far `dissipated` has fallen from its largest value
  double imbalance = 0;   ///< the largest |balance()| at the end of any step; zero by definition where not accounted
  long instants = 0;      ///< at which energies were looked at
  bool is_accounted = true;   ///< in each step; else `dissipated` is what the energies at some instants lack
};

}   // namespace cablenet::system
