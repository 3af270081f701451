#pragma once
#include <unordered_map>
#include <vector>

#include "cablenet/petsc/handle.hpp"
#include "cablenet/solve/network_pc.hpp"
#include "coupling_exchange.hpp"
#include "interface_system.hpp"
#include "matrix_blocks.hpp"

namespace cablenet::solve {

/// Local blocks: the interior nodes, then the interface nodes at them (`kept_`, by their places in the interface).
/// "Node" stands for a body as well.
class NetworkPc::Impl {
public:
  Impl(const partition::LocalNetwork& network, Mat matrix);

  bool plan(const partition::LocalNetwork& network, double most_per_node);
  PetscErrorCode set_up(PC pc);
  PetscErrorCode apply(PC pc, Vec b, Vec x);
  double updates_per_node() const { return updates_per_node_; }
  PivotReport pivots() const;

private:
  elimination::Pattern pattern();
  void find_couplings();
  elimination::BlockSource source(int row, int column);
  int owner(int number) const;
  int ranks() const {
    int count = 1;
    MPI_Comm_size(communicator_, &count);
    return count;
  }
  int interface_number(int kept) const {
    return numbers_[static_cast<std::size_t>(kept_[static_cast<std::size_t>(kept)])];
  }
  int number(int local) const {
    return local < interior_ ? blocks_.first() + local : interface_number(local - interior_);
  }
  void find_shares();
  void add_to_interface(const double* b);
  bool solve(const double* b, double* x);

  std::size_t interior_unknowns() const { return static_cast<std::size_t>(blocks_.begin(interior_)); }

  Mat matrix_;
  MPI_Comm communicator_;
  partition::Blocks sizes_;   ///< of all ranks, by solver number
  MatrixBlocks blocks_;
  int interior_;
  std::vector<int> numbers_;             ///< of the interface nodes
  std::unordered_map<int, int> place_;   ///< in numbers_
  std::vector<int> kept_;
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
    InterfaceSystem::Place to;
  };
  struct LeftShare {
    const double* from;
    std::size_t stride;
    InterfaceSystem::Place to;
    bool transposed;
  };
  std::vector<int> own_places_;   ///< of this rank's interface nodes in numbers_
  std::vector<OwnShare> own_shares_;
  std::vector<LeftShare> left_shares_;
};

}   // namespace cablenet::solve
