#include "coupling_exchange.hpp"

#include <algorithm>

#include "cablenet/petsc/phase.hpp"

namespace cablenet::solve {

void CouplingExchange::settle() {
  std::size_t received = 0, sent = 0;
  for (auto& [rank, couplings] : receives_) {
    const std::size_t begin = received;
    for (auto& [name, source] : couplings) {
      const int rows = blocks_.size(name.first), columns = blocks_.size(name.second);
      source = elimination::block_source(static_cast<int>(received), columns, 2);
      received += static_cast<std::size_t>(rows * columns);
    }
    from_.push_back({rank, begin, received - begin});
  }
  for (const auto& [rank, couplings] : sends_) {
    const std::size_t begin = sent;
    for (const auto& [name, source] : couplings) {
      sources_.push_back({source, blocks_.size(name.first), blocks_.size(name.second)});
      sent += static_cast<std::size_t>(sources_.back().rows * sources_.back().columns);
    }
    to_.push_back({rank, begin, sent - begin});
  }
  received_.resize(received);
  sent_.resize(sent);
  requests_.resize(to_.size() + from_.size());
}

void CouplingExchange::run(const elimination::Arrays& arrays) {
  const petsc::Timer timer(petsc::Phase::exchange);
  auto request = requests_.begin();
  for (const auto& [rank, begin, values] : from_)
    MPI_Irecv(received_.data() + begin, static_cast<int>(values), MPI_DOUBLE, rank, tag_, communicator_, &*request++);
  double* to = sent_.data();
  for (const auto& [source, rows, columns] : sources_)
    for (int r = 0; r < rows; ++r)
      to = std::copy_n(arrays[source.array] + source.offset + r * static_cast<int>(source.stride), columns, to);
  for (const auto& [rank, begin, values] : to_)
    MPI_Isend(sent_.data() + begin, static_cast<int>(values), MPI_DOUBLE, rank, tag_, communicator_, &*request++);
  MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
}

}   // namespace cablenet::solve
