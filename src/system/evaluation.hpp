#pragma once
#include <vector>

#include "cablenet/petsc/values.hpp"
#include "cablenet/system/force_rule.hpp"
#include "cablenet/system/situation.hpp"
#include "cablenet/system/slot.hpp"
#include "node_data.hpp"

namespace cablenet::system {

class BodyTerm;
struct CarriedNodes;

/// The motion of the nodes that this rank does not own, and the forces on them.
struct OutsideNodes {
  explicit OutsideNodes(const partition::LocalNetwork& network);

  std::vector<NodeMotion> motion;
  std::vector<double> forces;
  std::vector<bodies::RotationState> ghost_rotations;
};

/// The solver's vectors, open while this lives.  The residual's values are cleared.
struct OpenVectors {
  OpenVectors(const partition::LocalNetwork& network, OutsideNodes& outside, Vec in_x, Vec in_v, Vec in_a, Vec in_r);

  const petsc::ReadValues x, v, a;
  const petsc::WrittenValues r;
  const NodeData data;
};

/// Where blocks of a tangent go.
struct TangentTarget {
  std::array<double*, 2> values{};
  const PairSlots* elements = nullptr;   ///< per element
  Shift shift;
  bool holds_water = false;
  double steadiness = 0;   ///< as in TangentRequest
  TurningRule turning{};
};

/// What terms are told of an evaluation, and where they say what failed.
struct Evaluation {
  const partition::LocalNetwork& network;
  const NodeData& data;
  const Situation& situation;
  const ForceRule& rule;
  GhostExchange& exchange;
  BodyTerm& bodies;
  CarriedNodes& carried;
  TangentTarget target{};
  bool has_rates = false;   ///< Some forces depend on velocities.
  bool has_residual = false;
  bool has_tangent = false;
  bool is_exchanging = false;
  bool is_complete = false;

  bool in_domain = true;
  int coincident = -1;   ///< scene number of an element without length

  /// The nodes of other ranks and those that bodies carry are where they belong from here on.  Owned nodes may be
  /// looked at before.  Collective.
  void complete();
  double time() const { return situation.stage.time(); }
  /// At which loads that depend on time are taken.  [s]
  double load_time() const { return network.held_time.value_or(time()); }
  bool conserves() const { return rule.conserves(situation.stage, network.surroundings.fluid.has_value()); }
};

/// Calls visit.operator()<with_residual, with_tangent>() as the evaluation asks, so that loops have no branch for it.
template <class Visit>
void visit_parts(const Evaluation& evaluation, Visit&& visit) {
  if (!evaluation.has_tangent) return visit.template operator()<true, false>();
  evaluation.has_residual ? visit.template operator()<true, true>() : visit.template operator()<false, true>();
}

}   // namespace cablenet::system
