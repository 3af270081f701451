#pragma once
#include <petscsf.h>

#include <vector>

#include "cablenet/partition/local_network.hpp"
#include "cablenet/petsc/handle.hpp"

/// Brings the motion of other ranks' nodes here.  Tests: tests/parallel/assembler_test.cpp
namespace cablenet::system {

/// Position, velocity, acceleration of a node that this rank does not own.
struct NodeMotion {
  double x[3];   ///< [m]
  double v[3];   ///< [m/s]
  double a[3];   ///< [m/s^2]
};

/// Member functions are collective; between begin and end other work may be done.
class GhostExchange {
public:
  GhostExchange(const partition::LocalNetwork& network, MPI_Comm communicator);

  /// @param x, v, a  3 doubles per owned node; those that are not given are sent as zero
  /// @param ghosts   receives the ghosts' motion, in local order, by the time of end()
  void begin(const double* x, const double* v, const double* a, NodeMotion* ghosts);
  void end();

private:
  using StarForest = petsc::Handle<PetscSF, PetscSFDestroy>;

  bool alone_ = true;
  std::vector<int> sent_;
  std::vector<NodeMotion> buffer_;
  NodeMotion* ghosts_ = nullptr;
  StarForest forest_;
  petsc::Handle<MPI_Datatype, MPI_Type_free> unit_;
};

}   // namespace cablenet::system
