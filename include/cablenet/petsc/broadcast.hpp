#pragma once
#include <petscsf.h>

#include <vector>

#include "cablenet/base/index.hpp"
#include "cablenet/petsc/handle.hpp"

namespace cablenet::petsc {

/// Sends items from the ranks that own them to the ranks that need them: one message per neighbour.  An item is a
/// struct of doubles.  The member functions are collective.
template <class Item>
struct Broadcast {
  /// @param roots   the number of items that this rank sends
  /// @param leaves  per item that is received here, its index in what begin() is given
  /// @param owner, index  per item that begin() is given, its owner and its index there
  void set_up(MPI_Comm communicator, std::size_t roots, std::vector<PetscInt> leaves, const std::vector<int>& owner,
              const std::vector<int>& index) {
    std::vector<PetscSFNode> places;
    for (const PetscInt leaf : leaves) places.push_back({owner[at(leaf)], index[at(leaf)]});
    sent.resize(roots);
    check(PetscSFCreate(communicator, forest.out()));
    check(PetscSFSetGraph(forest, static_cast<PetscInt>(roots), static_cast<PetscInt>(places.size()), leaves.data(),
                          PETSC_COPY_VALUES, places.data(), PETSC_COPY_VALUES));
    check(PetscSFSetUp(forest));
    MPI_Type_contiguous(sizeof(Item) / sizeof(double), MPI_DOUBLE, unit.out());
    MPI_Type_commit(unit.out());
  }
  /// `to` receives what `sent` is now, by the time of end().
  void begin(Item* to) {
    received = to;
    check(PetscSFBcastBegin(forest, unit, sent.data(), received, MPI_REPLACE));
  }
  void end() { check(PetscSFBcastEnd(forest, unit, sent.data(), received, MPI_REPLACE)); }

  std::vector<Item> sent;
  Item* received = nullptr;
  Handle<PetscSF, PetscSFDestroy> forest;
  Handle<MPI_Datatype, MPI_Type_free> unit;
};

}   // namespace cablenet::petsc
