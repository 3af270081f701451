#pragma once
#include <petscsf.h>

#include <vector>

#include "cablenet/network/network.hpp"
#include "cablenet/output/series.hpp"
#include "cablenet/petsc/handle.hpp"
#include "cablenet/system/assembler.hpp"

/// Brings every rank's nodes and elements into the scene's order, in equal blocks, for writing.
/// Tests: tests/parallel/frames_test.cpp
namespace cablenet::output {

/// All member functions are collective.
class Frames {
public:
  Frames(const network::Network& network, const partition::Partition& partition, const system::Assembler& assembler);

  const Mesh& mesh() const { return mesh_; }
  /// The frame of the assembler's observed state; its spans live until the next call.
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
  StarForest nodes_;       ///< nodes that a rank speaks for -> the blocks
  StarForest all_nodes_;   ///< all local nodes -> the blocks, to sum over ranks
  StarForest elements_;
  std::vector<double> tension_, strain_, node_tension_;   ///< local
  std::vector<double> points_, velocity_, block_node_tension_, block_tension_, block_strain_;
  std::vector<double> elements_at_node_;   ///< per node of the block
  std::vector<double> bodies_;             ///< on rank 0: positions, velocities, quaternions, angular velocities
};

}   // namespace cablenet::output
