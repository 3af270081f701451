#include <algorithm>
#include <limits>
#include <optional>
#include <set>

#include "cablenet/petsc/queries.hpp"
#include "network_pc_impl.hpp"

/// What the elimination needs to know of a matrix's pattern, once.
namespace cablenet::solve {
namespace {

using petsc::check;

int new_tag(Mat matrix) {
  PetscMPIInt tag = 0;
  check(PetscObjectGetNewTag(reinterpret_cast<PetscObject>(matrix), &tag));
  return tag;
}

}   // namespace

NetworkPc::Impl::Impl(const partition::LocalNetwork& network, Mat matrix)
    : matrix_(matrix),
      communicator_(PetscObjectComm(reinterpret_cast<PetscObject>(matrix))),
      sizes_(network.blocks),
      blocks_(matrix, sizes_),
      interior_(network.interior),
      numbers_(network.interface.number),
      exchange_(communicator_, sizes_, new_tag(matrix)) {
  for (std::size_t i = 0; i < numbers_.size(); ++i) interface_node_[numbers_[i]] = InterfaceNode(static_cast<int>(i));
  symmetric_ = petsc::is_known_symmetric(matrix) && sizes_.uniform();
}

elimination::BlockGraph NetworkPc::Impl::block_graph() {
  std::set<InterfaceNode> touched;
  const auto interface_node = [this](SolverNumber column) {
    const auto found = interface_node_.find(column);
    if (found == interface_node_.end()) throw petsc::Failure("two ranks' interiors are coupled in the matrix");
    return found->second;
  };
  const auto is_interior = [this](SolverNumber column) {
    return blocks_.is_own(column) && column - blocks_.first() < interior_;
  };
  for (int k = 0; k < interior_; ++k)
    blocks_.for_each(k, [&](SolverNumber column, const auto&) {
      if (!is_interior(column)) touched.insert(interface_node(column));
    });
  kept_.assign(touched.begin(), touched.end());
  const auto local = [&](SolverNumber column) {
    if (is_interior(column)) return column - blocks_.first();
    const auto found = std::lower_bound(kept_.begin(), kept_.end(), interface_node(column));
    return interior_ + static_cast<int>(found - kept_.begin());
  };
  elimination::BlockGraph graph{std::vector<int>(at(interior_) + kept_.size(), 3), interior_, {0}, {}};
  if (!sizes_.uniform())
    for (std::size_t k = 0; k < graph.size.size(); ++k) graph.size[k] = sizes_.size(number(static_cast<int>(k)));
  for (int k = 0; k < interior_; ++k) {
    blocks_.for_each(k, [&](SolverNumber column, const auto&) { graph.adjacent.push_back(local(column)); });
    graph.first.push_back(static_cast<int>(graph.adjacent.size()));
  }
  return graph;
}

/// The rank that has a node's row.
int NetworkPc::Impl::owner(SolverNumber number) const {
  const PetscInt* ranges = nullptr;
  check(MatGetOwnershipRanges(matrix_, &ranges));
  return static_cast<int>(std::upper_bound(ranges, ranges + ranks() + 1, PetscInt{sizes_.begin(number)}) - ranges) - 1;
}

/// Blocks (interface node, interior node) stand in the interface node's row, perhaps on another rank.
void NetworkPc::Impl::find_couplings() {
  for (int row = 0; row < blocks_.rows(); ++row)
    blocks_.for_each(row, [&](SolverNumber column, const elimination::BlockSource& source) {
      if (blocks_.is_own(column)) return;
      if (row < interior_)
        exchange_.add_receive(owner(column), column, blocks_.first() + row);
      else if (!interface_node_.contains(column))
        exchange_.add_send(owner(column), blocks_.first() + row, column, source);
    });
  exchange_.settle();
}

elimination::BlockSource NetworkPc::Impl::source(int row, int column) {
  const SolverNumber i = number(row), j = number(column);
  if (blocks_.is_own(i)) return blocks_.find(i - blocks_.first(), j);
  elimination::BlockSource mirror = blocks_.find(j - blocks_.first(), i);
  if (mirror.absent) return mirror;
  if (!symmetric_) return exchange_.source(owner(i), i, j);
  mirror.transposed = 1;
  return mirror;
}

bool NetworkPc::Impl::plan(const partition::LocalNetwork& network, double most_per_node) {
  const double nodes = std::max(1.0, static_cast<double>(sizes_.begin(SolverNumber(sizes_.count()))) / 3 / ranks());
  const bool listed = network.interface.graph.vertices() == static_cast<int>(numbers_.size());
  std::optional<elimination::Plan> own, shared;
  if (listed) own = elimination::make_plan(block_graph(), symmetric_, most_per_node * nodes);
  if (own)
    shared = elimination::make_plan(InterfaceSystem::block_graph(network.interface, sizes_), symmetric_,
                                    most_per_node * nodes - own->updates);
  updates_per_node_ = shared ? (own->updates + shared->updates) / nodes : std::numeric_limits<double>::infinity();
  MPI_Allreduce(MPI_IN_PLACE, &updates_per_node_, 1, MPI_DOUBLE, MPI_MAX, communicator_);
  if (updates_per_node_ > most_per_node) return false;
  if (!symmetric_) find_couplings();
  elimination_ =
      std::make_unique<elimination::Elimination>(std::move(*own), [this](int i, int j) { return source(i, j); });
  interface_ = std::make_unique<InterfaceSystem>(network.interface, std::move(*shared), communicator_);
  for (const InterfaceNode node : kept_) kept_values_.resize(kept_values_.size() + at(interface_->size(node)));
  find_shares();
  return true;
}

/// What this rank adds to the interface's matrix: the rows that it owns, and what its elimination leaves.
void NetworkPc::Impl::find_shares() {
  for (int row = interior_; row < blocks_.rows(); ++row) {
    own_interface_.push_back(interface_node_.at(blocks_.first() + row));
    blocks_.for_each(row, [&](SolverNumber column, const elimination::BlockSource& from) {
      if (const auto found = interface_node_.find(column); found != interface_node_.end())
        own_shares_.push_back({from, interface_->block(own_interface_.back(), found->second)});
    });
  }
  for (const auto& block : elimination_->plan().kept) {
    const InterfaceNode row = kept_[at(block.row - interior_)], column = kept_[at(block.column - interior_)];
    const InterfaceSystem::SummedBlock summed = interface_->block(row, column);
    const double* const update = elimination_->update(block);
    left_shares_.push_back({update, at(summed.columns), summed, false});
    if (symmetric_ && row != column)
      left_shares_.push_back({update, at(summed.columns), interface_->block(column, row), true});
  }
}

}   // namespace cablenet::solve
