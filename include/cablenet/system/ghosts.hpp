#pragma once
#include <vector>

#include "cablenet/partition/local_network.hpp"
#include "cablenet/petsc/broadcast.hpp"

/// Brings the motion of other ranks' nodes and bodies here.  Tests: tests/parallel/assembler_test.cpp
namespace cablenet::system {

/// Of a node that this rank does not own.
using NodeMotion = scene::Kinematics;

/// Member functions are collective; between begin and end other work may be done.
class GhostExchange {
public:
  GhostExchange(const partition::LocalNetwork& network, MPI_Comm communicator);

  /// @param x, v, a    the values of this rank's vectors; those that are not given are sent as zero
  /// @param ghosts     receives the ghosts' motion, in local order, by the time of end()
  /// @param rotations  likewise, of those that are bodies
  void begin(const double* x, const double* v, const double* a, NodeMotion* ghosts, bodies::RotationState* rotations);
  void end();

private:
  /// A body among the nodes that are sent.
  struct SentBody {
    std::size_t item;
    Unknown attitude;   ///< the first one in the vectors
    int unknowns;
  };

  void set_up_bodies(const partition::LocalNetwork& network, MPI_Comm communicator);

  bool alone_ = true;
  bool with_bodies_ = false;
  std::vector<Unknown> sent_nodes_;   ///< the first unknown of each in the vectors
  std::vector<SentBody> sent_bodies_;
  petsc::Broadcast<NodeMotion> nodes_;
  petsc::Broadcast<bodies::RotationState> rotations_;
};

}   // namespace cablenet::system
