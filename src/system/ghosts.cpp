#include "cablenet/system/ghosts.hpp"

#include <algorithm>
#include <numeric>

#include "cablenet/petsc/phase.hpp"

namespace cablenet::system {
namespace {

void copy_or_zero(double* to, const double* from, Unknown first, int count) {
  if (from == nullptr)
    std::fill_n(to, count, 0.0);
  else
    std::copy_n(from + first.value(), count, to);
}

}   // namespace

GhostExchange::GhostExchange(const partition::LocalNetwork& network, MPI_Comm communicator) {
  int ranks = 1;
  MPI_Comm_size(communicator, &ranks);
  alone_ = ranks == 1;
  with_bodies_ = !network.blocks.uniform();
  if (alone_) return;
  for (const LocalNode node : network.sent) sent_nodes_.push_back(network.begin[node]);
  std::vector<PetscInt> leaves(network.ghost_owner.size());
  std::iota(leaves.begin(), leaves.end(), 0);
  nodes_.set_up(communicator, sent_nodes_.size(), std::move(leaves), network.ghost_owner, network.ghost_index);
  if (with_bodies_) set_up_bodies(network, communicator);
}

void GhostExchange::set_up_bodies(const partition::LocalNetwork& network, MPI_Comm communicator) {
  for (std::size_t i = 0; i < network.sent.size(); ++i)
    if (const int more = network.blocks.size(network.number(network.sent[i])) - 3; more > 0)
      sent_bodies_.push_back({i, sent_nodes_[i] + 3, more});
  std::vector<PetscInt> leaves;
  for (int i = 0; i < network.ghosts; ++i)
    if (network.blocks.size(network.ghost_number[at(i)]) > 3) leaves.push_back(i);
  rotations_.set_up(communicator, sent_nodes_.size(), std::move(leaves), network.ghost_owner, network.ghost_index);
}

void GhostExchange::begin(const double* x, const double* v, const double* a, NodeMotion* ghosts,
                          bodies::RotationState* rotations) {
  if (alone_) return;
  const petsc::Timer timer(petsc::Phase::exchange);
  for (std::size_t i = 0; i < sent_nodes_.size(); ++i) {
    copy_or_zero(nodes_.sent[i].x.data(), x, sent_nodes_[i], 3);
    copy_or_zero(nodes_.sent[i].v.data(), v, sent_nodes_[i], 3);
    copy_or_zero(nodes_.sent[i].a.data(), a, sent_nodes_[i], 3);
  }
  nodes_.begin(ghosts);
  if (!with_bodies_) return;
  for (const auto& [item, attitude, unknowns] : sent_bodies_) {
    copy_or_zero(rotations_.sent[item].y.data(), x, attitude, unknowns);
    copy_or_zero(rotations_.sent[item].dy.data(), v, attitude, unknowns);
    copy_or_zero(rotations_.sent[item].ddy.data(), a, attitude, unknowns);
  }
  rotations_.begin(rotations);
}

void GhostExchange::end() {
  if (alone_) return;
  const petsc::Timer timer(petsc::Phase::exchange);
  nodes_.end();
  if (with_bodies_) rotations_.end();
}

}   // namespace cablenet::system
