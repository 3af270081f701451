#pragma once
#include <unordered_map>
#include <vector>

#include "cablenet/petsc/handle.hpp"
#include "cablenet/solve/network_pc.hpp"
#include "coupling_exchange.hpp"
#include "interface_system.hpp"
#include "matrix_blocks.hpp"

namespace cablenet::solve {

/// This rank's elimination numbers its blocks locally: first the interior nodes, then the interface nodes that are
/// coupled to them (`kept_`).  "Node" stands for a body as well.
class NetworkPc::Impl {
public:
  Impl(const partition::LocalNetwork& network, Mat matrix);

  bool plan(const partition::LocalNetwork& network, double most_per_node);
  PetscErrorCode set_up(PC pc);
  PetscErrorCode apply(PC pc, Vec b, Vec x);
  double updates_per_node() const { return updates_per_node_; }
  PivotReport pivots() const;

private:
  elimination::BlockGraph block_graph();
  void find_couplings();
  elimination::BlockSource source(int row, int column);
  int owner(SolverNumber number) const;
  int ranks() const {
    int count = 1;
    MPI_Comm_size(communicator_, &count);
    return count;
  }
  /// The solver number of a local block.
  SolverNumber number(int local) const {
    return local < interior_ ? blocks_.first() + local : numbers_[at(kept_[at(local - interior_)])];
  }
  void find_shares();
  void add_to_interface(const double* b);
  bool solve(const double* b, double* x);

  std::size_t interior_unknowns() const { return at(blocks_.begin(interior_)); }

  Mat matrix_;
  MPI_Comm communicator_;
  partition::Blocks sizes_;   ///< of all ranks, by solver number
  MatrixBlocks blocks_;
  int interior_;
  std::vector<SolverNumber> numbers_;   ///< of the interface nodes
  std::unordered_map<SolverNumber, InterfaceNode> interface_node_;
  std::vector<InterfaceNode> kept_;
  bool symmetric_ = false;
  bool new_matrix_ = false;
  CouplingExchange exchange_;
  std::unique_ptr<elimination::Elimination> elimination_;
  std::unique_ptr<InterfaceSystem> interface_;
  double updates_per_node_ = 0;
  elimination::Pivots pivots_;
  int is_singular_ = 0;
  std::vector<double> kept_values_;

  struct OwnShare {
    elimination::BlockSource from;
    InterfaceSystem::SummedBlock to;
  };
  struct LeftShare {
    const double* from;
    std::size_t stride;
    InterfaceSystem::SummedBlock to;
    bool transposed;
  };
  std::vector<InterfaceNode> own_interface_;   ///< this rank's nodes
  std::vector<OwnShare> own_shares_;
  std::vector<LeftShare> left_shares_;
};

}   // namespace cablenet::solve
