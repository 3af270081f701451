#include "interface_system.hpp"

#include <algorithm>
#include <numeric>

#include "cablenet/petsc/phase.hpp"

namespace cablenet::solve {
namespace {

partition::Graph rows_of(const partition::Graph& graph) {
  partition::Graph rows;
  rows.first.push_back(0);
  for (int i = 0; i < graph.vertices(); ++i) {
    const auto begin = static_cast<std::ptrdiff_t>(rows.adjacent.size());
    rows.adjacent.insert(rows.adjacent.end(), graph.adjacent.begin() + graph.first[at(i)],
                         graph.adjacent.begin() + graph.first[at(i) + 1]);
    rows.adjacent.push_back(i);
    std::sort(rows.adjacent.begin() + begin, rows.adjacent.end());
    rows.first.push_back(static_cast<int>(rows.adjacent.size()));
  }
  return rows;
}

}   // namespace

elimination::BlockGraph InterfaceSystem::block_graph(const partition::Interface& interface,
                                                     const partition::Blocks& blocks) {
  std::vector<int> size;
  for (const SolverNumber number : interface.number) size.push_back(blocks.size(number));
  const int nodes = static_cast<int>(size.size());
  return {std::move(size), nodes, nodes == 0 ? std::vector<int>{0} : interface.graph.first, interface.graph.adjacent};
}

InterfaceSystem::InterfaceSystem(const partition::Interface& interface, elimination::Plan plan, MPI_Comm communicator)
    : communicator_(communicator), rows_(rows_of(interface.graph)), begin_(1, 0) {
  for (const int size : plan.size) begin_.push_back(*(begin_.end() - 1) + at(size));
  failures_ = *(begin_.end() - 1);
  std::size_t values = failures_ + 1;
  for (int row = 0; row < rows_.vertices(); ++row)
    for (int i = rows_.first[at(row)]; i < rows_.first[at(row) + 1]; ++i) {
      block_begins_.push_back(values);
      values += at(size(InterfaceNode(row)) * size(InterfaceNode(rows_.adjacent[at(i)])));
    }
  sum_.resize(values);
  const auto where = [this](int i, int j) {
    const auto first = rows_.adjacent.begin() + rows_.first[at(i)];
    const auto last = rows_.adjacent.begin() + rows_.first[at(i) + 1];
    const InterfaceNode row(i), column(j);
    if (!std::binary_search(first, last, j)) return elimination::BlockSource{};
    return elimination::block_source(static_cast<int>(block(row, column).begin), size(column), 0);
  };
  elimination_ = std::make_unique<elimination::Elimination>(std::move(plan), where);
}

InterfaceSystem::SummedBlock InterfaceSystem::block(InterfaceNode row, InterfaceNode column) const {
  const auto first = rows_.adjacent.begin() + rows_.first[at(row)];
  const auto found = std::lower_bound(first, rows_.adjacent.begin() + rows_.first[at(row) + 1], column.value());
  return {block_begins_[static_cast<std::size_t>(found - rows_.adjacent.begin())], size(row), size(column)};
}

void InterfaceSystem::clear(bool new_matrix) {
  new_matrix_ = new_matrix;
  std::fill(sum_.begin(), new_matrix ? sum_.end() : sum_.begin() + static_cast<std::ptrdiff_t>(failures_) + 1, 0.0);
}

void InterfaceSystem::add(const SummedBlock& block, const double* values, std::size_t stride, bool transposed) {
  double* to = sum_.data() + block.begin;
  const std::size_t down = transposed ? 1 : stride, right = transposed ? stride : 1;
  const std::size_t rows = at(block.rows), columns = at(block.columns);
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) *to++ += values[r * down + c * right];
}

bool InterfaceSystem::solve() {
  {
    const petsc::Timer timer(petsc::Phase::exchange);
    const std::size_t count = new_matrix_ ? sum_.size() : failures_ + 1;
    MPI_Allreduce(MPI_IN_PLACE, sum_.data(), static_cast<int>(count), MPI_DOUBLE, MPI_SUM, communicator_);
  }
  if (sum_[failures_] != 0) return false;
  const petsc::Timer timer(petsc::Phase::solve);
  if (new_matrix_) pivots_ = elimination_->factor({sum_.data(), nullptr, nullptr});
  if (pivots_.singular >= 0) return false;
  elimination_->forward(sum_.data(), nullptr);
  elimination_->backward(sum_.data(), nullptr);
  return true;
}

}   // namespace cablenet::solve
