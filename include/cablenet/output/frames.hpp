#pragma once
#include <petscsf.h>

#include <vector>

#include "cablenet/network/network.hpp"
#include "cablenet/output/series.hpp"
#include "cablenet/petsc/handle.hpp"
#include "cablenet/system/assembler.hpp"

/// Before they are written, the values of all ranks are brought into the scene's order.  Each rank then holds one block
/// of nodes and one of elements.  The blocks of two ranks differ by at most one in size.
/// Tests: tests/parallel/frames_test.cpp
namespace cablenet::output {

/// All member functions are collective.
class Frames {
public:
  Frames(const network::Network& network, const partition::Partition& partition, const system::Assembler& assembler);

  const Mesh& mesh() const { return mesh_; }
  /// The frame of the assembler's observed state.  Its spans are valid until the next call.
  Frame collect(const system::LocalState& state, long step);

private:
  using StarForest = petsc::Handle<PetscSF, PetscSFDestroy>;

  void fill_mesh(const network::Network& network, const partition::Partition& partition);
  void make_forests();
  void fill_bodies(const network::Network& network);
  void collect_bodies(const system::LocalState& state);
  void compute_tensions(const system::LocalState& state);

  const system::Assembler& assembler_;
  int rank_ = 0;
  int ranks_ = 1;
  Mesh mesh_;
  StarForest nodes_;                                      ///< from the nodes that a rank speaks for to the blocks
  StarForest all_nodes_;                                  ///< from all local nodes to the blocks, for sums over ranks
  StarForest elements_;                                   ///< from a rank's own elements to the blocks
  std::vector<double> tension_, strain_, node_tension_;   ///< of this rank's own elements and of its nodes
  std::vector<double> points_, velocity_, block_node_tension_, block_tension_, block_strain_;
  std::vector<double> elements_at_node_;   ///< per node of the block: number of elements
  std::vector<double> bodies_;             ///< on rank 0: positions, velocities, quaternions, angular velocities
};

}   // namespace cablenet::output
