#pragma once
#include <span>

#include "block_pattern.hpp"
#include "cablenet/base/archive.hpp"
#include "cablenet/system/force_scales.hpp"
#include "cablenet/system/local_state.hpp"
#include "evaluation.hpp"

namespace cablenet::system {

inline double square(double value) { return value * value; }

/// The end of an accepted step, and the vectors' values there.
struct StepEnd {
  const Stage& stage;
  bool conserves;   ///< Bodies were taken from end to end.
  double* x;
  double* v;
};

/// The energy account that a term's work goes to (energy_accounts.hpp).  What stores energy is the scheme's.
enum class Account { scheme, water, bed };

/// One physics of the network: what a term has to say beside its forces.  A term derives from this, and hides what it
/// has to say itself.  Nothing here is virtual: terms.hpp lists the types.  A term's forces and tangent are
///   void add(Evaluation&);
/// which adds its share of r = M a + internal forces - loads [N] and of dr/dx shift.x + dr/dv shift.v + dr/da shift.a
/// [N/m], as far as the evaluation asks for them.
class Term {
public:
  static constexpr Account account = Account::scheme;

  explicit Term(const partition::LocalNetwork& network) : network_(network) {}

  /// Some of its forces depend on velocities.
  bool has_rates() const { return false; }
  /// Its tangent is symmetric, whatever the state.
  bool is_symmetric(const ForceRule&) const { return true; }
  /// Asks for the blocks that the term fills, in the order in which it fills them.
  void couplings(BlockPattern&) {}
  /// Keeps what its forces need of the step's start.
  void begin_step(Evaluation&) {}
  /// Ends an accepted step, of which this was the last evaluation.  Not collective.
  void end_step(const StepEnd&) {}
  /// Adds this rank's part of what the term stores, and of the work that it has done.  [J]
  void add_energy(const LocalState&, Energies&) const {}
  /// Adds this rank's part of the potential of the internal forces and of the bed, as statics' situation has them.  [J]
  void add_potential(const Situation&, const LocalState&, double&) const {}
  /// Adds this rank's squares of forces and stiffnesses.
  void add_scales(const LocalState&, ForceSums&) const {}
  /// The term's share of what pulls at an element's end: its residual there.  [N]
  /// @param element  an index into LocalNetwork::elements   @param end  0 or 1
  Vector3 end_force(const LocalState&, int /*element*/, std::size_t /*end*/) const { return Vector3::Zero(); }
  /// The term's share of what acts on a node beside its elements: its residual there.  [N]
  Vector3 node_force(const LocalState&, LocalNode) const { return Vector3::Zero(); }
  /// Saves or loads what is kept from step to step.
  void archive(Archive&) {}

protected:
  /// Those that this rank speaks for.
  std::span<const partition::LocalElement> own_elements() const {
    return {network_.elements.data(), at(network_.own_elements)};
  }

  const partition::LocalNetwork& network_;
};

}   // namespace cablenet::system
