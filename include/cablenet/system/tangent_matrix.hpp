#pragma once
#include <petscmat.h>

#include <array>

#include "cablenet/partition/local_network.hpp"
#include "cablenet/petsc/handle.hpp"

namespace cablenet::system {

using Matrix = petsc::Handle<Mat, MatDestroy>;

class BlockPattern;

/// The tangent as a PETSc matrix whose arrays are written directly.  It has 3x3 blocks, and larger ones at bodies.
/// Tests: tests/parallel/assembler_test.cpp
class TangentMatrix {
public:
  /// Collective.  -mat_type may ask for another type than AIJ; what is written is then converted into that.
  /// @param symmetric  the tangent is, whatever the state
  TangentMatrix(const partition::LocalNetwork& network, const BlockPattern& pattern, bool symmetric,
                MPI_Comm communicator);

  /// For solvers.
  Mat matrix() const { return converted_ != nullptr ? converted_ : aij_; }

  /// The values in this rank's columns and in those of others, open until close().  Not collective.
  std::array<double*, 2> open();
  void close();
  /// Hands what was written to the solvers.  Collective.
  void publish();
  /// Becomes s I.  Collective.
  void set_identity(double s);

private:
  void convert();

  Matrix aij_;
  Matrix converted_;
  std::array<Mat, 2> parts_{};   ///< of aij_: columns of this rank, of others
  std::array<double*, 2> values_{};
};

}   // namespace cablenet::system
