#pragma once
#include <petscmat.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "cablenet/network/network.hpp"
#include "cablenet/solve/static_forces.hpp"

/// The stiffness K of a node in an equilibrium: the force that it takes to hold the node displaced by dx, less the one
/// that holds it where it is, is K dx, with everything else in equilibrium again.  So what restores is -K dx.
/// With the tangent's blocks of the node p and of all other unknowns f,  K = T_pp - T_pf T_ff^-1 T_fp.
/// Of a free node it is the inverse of the flexibility.
/// For a body with an attitude K is 6x6.  Its rows are the force and the moment about the centre of gravity.  Its
/// columns are the displacement and a small rotation vector.  All are in the world's axes; bodies/small_turn.hpp
/// converts them from the unknowns of the attitude. Units: N/m, N by rotation [rad], N m/m, N m/rad. Tests:
/// tests/parallel/condensed_stiffness_test.cpp, tests/verification/stiffness.py
namespace cablenet::solve {

/// All ranks' shares together: the network as it stands at a start that Assembler::start_from has set.  Collective.
network::Network at_start_of(network::Network network, const system::Assembler& assembler);

/// All member functions are collective.
class CondensedStiffness {
public:
  using Matrix = Eigen::MatrixXd;

  /// Reads the options database (-ksp_*, -pc_*).
  /// @param standing  in equilibrium in the frame of this velocity [m/s]
  /// @param asked     nodes of points or bodies; those that the scene holds or moves are held but for the asking
  CondensedStiffness(network::Network standing, const std::vector<SceneNode>& asked, const system::ForceRule& rule,
                     double t, const Vector3& velocity, MPI_Comm communicator);
  ~CondensedStiffness();

  /// Three rows, or six of a body that turns.  Nothing where what is left of the network has no stiffness of its own.
  std::optional<Matrix> of(SceneNode node);

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}   // namespace cablenet::solve
