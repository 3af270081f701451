#pragma once
#include <mpi.h>

#include <map>
#include <utility>
#include <vector>

#include "cablenet/elimination/elimination.hpp"
#include "cablenet/partition/blocks.hpp"

namespace cablenet::solve {

/// Sends the blocks (interface node, interior node) from the rank that has the row to the one that eliminates the
/// column.  A symmetric matrix does not need it.
class CouplingExchange {
public:
  /// @param blocks  by solver number   @param tag  not in use by others on the communicator
  CouplingExchange(MPI_Comm communicator, const partition::Blocks& blocks, int tag)
      : communicator_(communicator), blocks_(blocks), tag_(tag) {}

  /// Every block must be told to both ranks before the first run().
  void add_send(int rank, SolverNumber row, SolverNumber column, const elimination::BlockSource& source) {
    sends_[rank][{row, column}] = source;
  }
  void add_receive(int rank, SolverNumber row, SolverNumber column) { receives_[rank][{row, column}] = {}; }
  /// After the last add_receive: where block (row, column) will stand in received().
  void settle();
  elimination::BlockSource source(int rank, SolverNumber row, SolverNumber column) const {
    return receives_.at(rank).at({row, column});
  }

  const double* received() const { return received_.data(); }
  /// Between neighbours; every rank must call it.
  void run(const elimination::Arrays& arrays);

private:
  using Couplings = std::map<std::pair<SolverNumber, SolverNumber>, elimination::BlockSource>;

  /// A neighbour's share of a buffer.
  struct Message {
    int rank;
    std::size_t begin, values;
  };

  /// What is sent of one coupling.
  struct Sent {
    elimination::BlockSource source;
    int rows, columns;
  };

  MPI_Comm communicator_;
  const partition::Blocks& blocks_;
  int tag_;
  std::map<int, Couplings> sends_, receives_;
  std::vector<Sent> sources_;
  std::vector<Message> to_, from_;
  std::vector<double> sent_, received_;
  std::vector<MPI_Request> requests_;
};

}   // namespace cablenet::solve
