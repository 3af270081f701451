#pragma once
#include <vector>

#include "cablenet/bodies/carrying.hpp"
#include "carried_nodes.hpp"
#include "term.hpp"

namespace cablenet::system {

/// Rigid bodies: their inertia, their constant torques, and the nodes that they carry.  An evaluation places the
/// carried nodes first.  The other terms leave forces and blocks on those.  This term comes last and collects them.
/// Tests: tests/parallel/bodies_test.cpp
class BodyTerm : public Term {
public:
  explicit BodyTerm(const partition::LocalNetwork& network);

  /// Clears the bodies' own blocks of the matrix, before anything is added to them.
  void clear_blocks(const TangentTarget& target) const;
  /// Keeps the attitudes of a step's start, and places the carried nodes, which the other terms look at.
  void start_step(const NodeData& data);
  /// Places the carried nodes at the stage and clears their forces.
  void carry(Evaluation& evaluation);
  CarriedNodes& carried() { return carried_; }
  const bodies::StageForces& forces(int body) const { return forces_[at(body)]; }
  int unknowns(int body) const { return bodies::rotation_unknowns(network_.bodies[at(body)].properties.rotation); }
  /// Index into Network::bodies of one that left its domain in the last evaluation; -1: none.
  int outside() const { return outside_; }
  /// Index into Network::bodies of one whose Euler angles are singular within a degree of pitch; -1: none.
  int nearly_singular(const NodeData& data) const;
  /// Writes a body's attitude and its rate to the vectors' values.
  void put(int body, const bodies::RotationState& state, double* x, double* v) const;
  /// Attitudes and angular velocities of all bodies here.
  std::vector<BodyState> states(const NodeData& data) const;

  /// Bodies with an attitude have blocks larger than 3x3 somewhere.
  bool is_symmetric(const ForceRule&) const { return network_.blocks.uniform(); }
  void couplings(BlockPattern& pattern) { slots_ = pattern.own(network_.bodies); }
  void add(Evaluation& evaluation);
  void end_step(const StepEnd& end);
  void add_energy(const LocalState& state, Energies& sum) const;
  void add_scales(const LocalState& state, ForceSums& sums) const;
  void archive(Archive& archive) { archive.item("work of torques", work_); }

private:
  std::span<const partition::LocalCarried> carried_by(const partition::LocalBody& body) const {
    return {network_.carried.data() + body.first_carried, at(body.carried)};
  }
  bodies::RotationState rotation(int body, const NodeData& data) const;
  void carry_body(int body, const Evaluation& evaluation, const bodies::StepRule& rule, bodies::StageMotion& motion);
  bodies::CarriedForces collect(int body, const NodeData& data) const;
  double largest_torque(int body, const NodeData& data) const;
  void add_block(int body, const TangentTarget& target);

  std::vector<bodies::Start> starts_;
  std::vector<bodies::StageForces> forces_;
  CarriedNodes carried_;
  std::vector<Slot> slots_;
  int outside_ = -1;
  double work_ = 0;   ///< of the torques since the start [J]
};

}   // namespace cablenet::system
