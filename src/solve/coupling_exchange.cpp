#include "coupling_exchange.hpp"

#include <algorithm>

#include "cablenet/petsc/phase.hpp"

namespace cablenet::solve {

void CouplingExchange::settle() {
  std::size_t received = 0;
  for (auto& [rank, blocks] : receives_) {
    from_.push_back({rank, received, 9 * blocks.size()});
    for (auto& [name, source] : blocks) {
      source = elimination::block_source(static_cast<int>(received), 3, 2);
      received += 9;
    }
  }
  for (const auto& [rank, blocks] : sends_) {
    to_.push_back({rank, 9 * sources_.size(), 9 * blocks.size()});
    for (const auto& [name, source] : blocks) sources_.push_back(source);
  }
  received_.resize(received);
  sent_.resize(9 * sources_.size());
  requests_.resize(to_.size() + from_.size());
}

void CouplingExchange::run(const elimination::Arrays& arrays) {
  const petsc::Timer timer(petsc::Phase::exchange);
  auto request = requests_.begin();
  for (const auto& [rank, begin, values] : from_)
    MPI_Irecv(received_.data() + begin, static_cast<int>(values), MPI_DOUBLE, rank, tag_, communicator_, &*request++);
  double* to = sent_.data();
  for (const auto& source : sources_)
    for (int r = 0; r < 3; ++r)
      to = std::copy_n(arrays[source.array] + source.offset + r * static_cast<int>(source.stride), 3, to);
  for (const auto& [rank, begin, values] : to_)
    MPI_Isend(sent_.data() + begin, static_cast<int>(values), MPI_DOUBLE, rank, tag_, communicator_, &*request++);
  MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
}

}   // namespace cablenet::solve
