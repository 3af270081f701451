#pragma once
#include <petscsf.h>

#include <vector>

#include "cablenet/partition/local_network.hpp"
#include "cablenet/petsc/handle.hpp"

/// Brings the motion of other ranks' nodes and bodies here.  Tests: tests/parallel/assembler_test.cpp
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

  /// @param x, v, a    the values of this rank's vectors; those that are not given are sent as zero
  /// @param ghosts     receives the ghosts' motion, in local order, by the time of end()
  /// @param rotations  likewise, of those that are bodies
  void begin(const double* x, const double* v, const double* a, NodeMotion* ghosts, bodies::RotationState* rotations);
  void end();

private:
  /// One message per neighbour, of as many doubles an item as `Item` has.
  template <class Item>
  struct Broadcast {
    void set_up(MPI_Comm communicator, std::size_t roots, std::vector<PetscInt> leaves,
                std::vector<PetscSFNode> places);
    void begin(Item* to);
    void end();

    std::vector<Item> sent;
    Item* received = nullptr;
    petsc::Handle<PetscSF, PetscSFDestroy> forest;
    petsc::Handle<MPI_Datatype, MPI_Type_free> unit;
  };
  /// A body among the nodes that are sent.
  struct SentBody {
    std::size_t item;
    Unknown place;   ///< of its attitude's unknowns in the vectors
    int unknowns;
  };

  void set_up_bodies(const partition::LocalNetwork& network, MPI_Comm communicator);

  bool alone_ = true;
  bool with_bodies_ = false;
  std::vector<Unknown> places_;   ///< of the sent nodes in the vectors
  std::vector<SentBody> sent_bodies_;
  Broadcast<NodeMotion> nodes_;
  Broadcast<bodies::RotationState> rotations_;
};

}   // namespace cablenet::system
