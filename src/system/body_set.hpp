#pragma once
#include <vector>

#include "cablenet/bodies/rigid_body.hpp"
#include "cablenet/elements/cable_in_water.hpp"
#include "cablenet/partition/local_network.hpp"
#include "cablenet/system/rules.hpp"
#include "cablenet/system/tangent_matrix.hpp"
#include "node_data.hpp"

namespace cablenet::system {

/// Row-major, as the matrix that such parts go to.
template <int rows, int columns>
using RowMajor = Eigen::Matrix<double, rows, columns, Eigen::RowMajor>;

/// How a carried node's motion follows its body's attitude, by its unknowns; zero columns where those are fewer than
/// four.  The body's position comes on top as it is.
struct CarriedTangent {
  RowMajor<3, 4> x = RowMajor<3, 4>::Zero(), v = x, a = x;
  bodies::Matrix34 load = x;   ///< a force F is the generalised force load^T F on the attitude
  int unknowns = 0;            ///< of the attitude
};

/// Derivatives of a force by a node's motion [N/m], [N s/m], [kg].
struct MotionSlopes {
  Matrix3 by_x, by_v, by_a;
};

/// A body's block of the tangent while its parts are collected, and a column to spare.
using BodyBlock = RowMajor<7, 8>;

/// The bodies at this rank's nodes during an evaluation: first they place the nodes that they carry, then elements
/// leave forces on those, and the bodies collect them.
class BodySet {
public:
  /// @param is_damped  some cable's forces depend on velocities
  BodySet(const partition::LocalNetwork& network, bool is_damped);

  bool empty() const { return network_.bodies.empty(); }

  /// Keeps the step's start, where it places the carried nodes.
  void begin_step(const NodeData& data);
  /// Sets the carried nodes' motion at the stage and clears their forces.
  /// @param shift  with it, also carried_tangent()
  /// @returns false where a body has left its domain: outside() says which
  bool place(const Stage& stage, bool conserving, const NodeData& data, const Shift* shift);
  /// Index into LocalNetwork::bodies; -1: none.
  int outside() const { return outside_; }

  const CarriedTangent& carried_tangent(LocalNode node) const;
  /// Where a part of the block of the body that carries `node` is added; nullptr if it is another rank's.
  BodyBlock* block_at(LocalNode node);

  /// Adds what water does at the bodies' centres of gravity.
  /// @param follow  with it, the derivatives go to the bodies' own blocks
  void add_water(const environment::Fluid& fluid, double t, const NodeData& data, const Shift* follow,
                 bool follows_turning);

  /// Adds what the bodies' own inertia and the forces on carried nodes come to, where data has a residual, and writes
  /// the bodies' own blocks of the tangent, where there is one.
  /// @param steadiness  as in TangentRequest
  void collect(const NodeData& data, TangentMatrix* tangent, double steadiness);

  /// Ends an accepted step: conserving ones set their own end velocities.
  /// @returns the work of the constant torques [J]
  double end_step(const Stage& stage, bool conserving, double* x, double* v) const;
  bodies::RotationState rotation(std::size_t body, const NodeData& data) const;

private:
  /// F and F r^T of a body's attachments.
  struct Sums {
    Vector3 force;
    bodies::Moments moments;
  };
  Sums sums(std::size_t body, const NodeData& data) const;
  void add_forces(std::size_t body, const Sums& sum, const Vector3& torque, const NodeData& data) const;
  void add_steadiness(std::size_t body, double stiffness);
  double largest_torque(std::size_t body, const NodeData& data) const;
  void write_block(std::size_t body, const Sums& sum, const Vector3& torque, double* values,
                   const TangentMatrix::Slot& slot);
  int unknowns(std::size_t body) const { return bodies::rotation_unknowns(network_.bodies[body].properties.rotation); }

  const partition::LocalNetwork& network_;
  bool is_damped_;
  std::vector<bodies::Start> starts_;
  std::vector<bodies::StageForces> forces_;
  std::vector<CarriedTangent> tangents_;
  std::vector<BodyBlock> blocks_;
  int outside_ = -1;
};

}   // namespace cablenet::system
