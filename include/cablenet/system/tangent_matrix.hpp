#pragma once
#include <petscmat.h>

#include <array>
#include <vector>

#include "cablenet/partition/local_network.hpp"
#include "cablenet/petsc/handle.hpp"

/// The tangent as a PETSc matrix that elements write into directly.  Tests: tests/parallel/assembler_test.cpp
namespace cablenet::system {

using Matrix = petsc::Handle<Mat, MatDestroy>;

/// An AIJ matrix of 3x3 blocks, larger ones at bodies, of whose arrays each element knows its places.  Blocks are
/// written, not added to, by the first element at them, so that nothing has to be cleared.
class TangentMatrix {
public:
  /// Where a block stands: rows of `stride` values from arrays()[other] + offset.
  struct Slot {
    int offset = 0;
    unsigned stride : 29 = 0;
    unsigned add : 1 = 0;      ///< an earlier element has written it
    unsigned other : 1 = 0;    ///< its column belongs to another rank
    unsigned absent : 1 = 1;   ///< its row or column is not an unknown of this rank's rows
  };
  /// The blocks (1, 1), (1, 2), (2, 1), (2, 2) of an element's nodes, bodies for those that they carry.  A body's own
  /// block is not among them: body_slots().
  using ElementSlots = std::array<Slot, 4>;

  /// Collective.  -mat_type may ask for another type than AIJ, which is then converted into.
  /// @param symmetric  the tangent is, whatever the state
  TangentMatrix(const partition::LocalNetwork& network, bool symmetric, MPI_Comm communicator);

  /// For solvers.
  Mat matrix() const { return converted_ != nullptr ? converted_ : aij_; }
  const std::vector<ElementSlots>& element_slots() const { return element_slots_; }
  const std::vector<ElementSlots>& link_slots() const { return link_slots_; }
  /// Diagonal blocks of this rank's bodies: written after all elements.
  const std::vector<Slot>& body_slots() const { return body_slots_; }
  /// Diagonal blocks of the network's loads and of the nodes that water acts on: written last.
  const std::vector<Slot>& load_slots() const { return load_slots_; }
  const std::vector<Slot>& wet_slots() const { return wet_slots_; }

  /// The values of the columns of this rank and of those of others, open until close().  Not collective.
  std::array<double*, 2> open();
  std::array<double*, 2> values() const { return values_; }   ///< @pre open
  void close();
  /// Hands what was written to the solvers.  Collective.
  void publish();
  /// s I.  Collective.
  void set_identity(double s);

private:
  class Pattern;

  Matrix aij_;
  Matrix converted_;
  std::array<Mat, 2> parts_{};   ///< of aij_: columns of this rank, of others
  std::array<double*, 2> values_{};
  std::vector<ElementSlots> element_slots_;
  std::vector<ElementSlots> link_slots_;
  std::vector<Slot> body_slots_;
  std::vector<Slot> load_slots_;
  std::vector<Slot> wet_slots_;
};

}   // namespace cablenet::system
