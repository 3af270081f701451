#include "coupling_exchange.hpp"

#include <algorithm>

#include "cablenet/petsc/phase.hpp"

namespace cablenet::solve {
namespace {

constexpr int tag = 17;

int values(std::size_t blocks) { return static_cast<int>(9 * blocks); }

}   // namespace

void CouplingExchange::settle() {
  int offset = 0;
  for (auto& [rank, blocks] : receives_)
    for (auto& [name, source] : blocks) {
      source = elimination::block_source(offset, 3, 2);
      offset += 9;
    }
  received_.resize(static_cast<std::size_t>(offset));
  std::size_t blocks_sent = 0;
  for (const auto& [rank, blocks] : sends_) blocks_sent += blocks.size();
  sent_.resize(9 * blocks_sent);
  requests_.resize(sends_.size() + receives_.size());
}

void CouplingExchange::run(const elimination::Arrays& arrays) {
  const petsc::Timer timer(petsc::Phase::exchange);
  auto request = requests_.begin();
  double* to = received_.data();
  for (const auto& [rank, blocks] : receives_) {
    MPI_Irecv(to, values(blocks.size()), MPI_DOUBLE, rank, tag, communicator_, &*request++);
    to += 9 * blocks.size();
  }
  double* from = sent_.data();
  for (const auto& [rank, blocks] : sends_) {
    double* const begin = from;
    for (const auto& [name, source] : blocks)
      for (int r = 0; r < 3; ++r)
        from = std::copy_n(arrays[source.array] + source.offset + r * static_cast<int>(source.stride), 3, from);
    MPI_Isend(begin, values(blocks.size()), MPI_DOUBLE, rank, tag, communicator_, &*request++);
  }
  MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
}

}   // namespace cablenet::solve
