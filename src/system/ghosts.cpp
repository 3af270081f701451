#include "cablenet/system/ghosts.hpp"

#include <algorithm>
#include <numeric>

#include "cablenet/petsc/phase.hpp"

namespace cablenet::system {
namespace {

using petsc::check;

void copy_or_zero(double* to, const double* from, Unknown place, int count) {
  if (from == nullptr)
    std::fill_n(to, count, 0.0);
  else
    std::copy_n(from + place.value(), count, to);
}

}   // namespace

template <class Item>
void GhostExchange::Broadcast<Item>::set_up(MPI_Comm communicator, std::size_t roots, std::vector<PetscInt> leaves,
                                            std::vector<PetscSFNode> places) {
  sent.resize(roots);
  check(PetscSFCreate(communicator, forest.out()));
  check(PetscSFSetGraph(forest, static_cast<PetscInt>(roots), static_cast<PetscInt>(places.size()), leaves.data(),
                        PETSC_COPY_VALUES, places.data(), PETSC_COPY_VALUES));
  check(PetscSFSetUp(forest));
  MPI_Type_contiguous(sizeof(Item) / sizeof(double), MPI_DOUBLE, unit.out());
  MPI_Type_commit(unit.out());
}

template <class Item>
void GhostExchange::Broadcast<Item>::begin(Item* to) {
  received = to;
  check(PetscSFBcastBegin(forest, unit, sent.data(), received, MPI_REPLACE));
}

template <class Item>
void GhostExchange::Broadcast<Item>::end() {
  check(PetscSFBcastEnd(forest, unit, sent.data(), received, MPI_REPLACE));
}

GhostExchange::GhostExchange(const partition::LocalNetwork& network, MPI_Comm communicator) {
  int ranks = 1;
  MPI_Comm_size(communicator, &ranks);
  alone_ = ranks == 1;
  with_bodies_ = !network.blocks.uniform();
  if (alone_) return;
  for (const LocalNode node : network.sent) places_.push_back(network.begin[node]);
  std::vector<PetscSFNode> places;
  for (std::size_t i = 0; i < network.ghost_owner.size(); ++i)
    places.push_back({network.ghost_owner[i], network.ghost_index[i]});
  std::vector<PetscInt> leaves(places.size());
  std::iota(leaves.begin(), leaves.end(), 0);
  nodes_.set_up(communicator, places_.size(), leaves, places);
  if (with_bodies_) set_up_bodies(network, communicator);
}

void GhostExchange::set_up_bodies(const partition::LocalNetwork& network, MPI_Comm communicator) {
  for (std::size_t i = 0; i < network.sent.size(); ++i)
    if (const int more = network.blocks.size(network.number(network.sent[i])) - 3; more > 0)
      sent_bodies_.push_back({i, places_[i] + 3, more});
  std::vector<PetscInt> leaves;
  std::vector<PetscSFNode> places;
  for (std::size_t i = 0; i < network.ghost_owner.size(); ++i)
    if (network.blocks.size(network.ghost_number[i]) > 3) {
      leaves.push_back(static_cast<PetscInt>(i));
      places.push_back({network.ghost_owner[i], network.ghost_index[i]});
    }
  rotations_.set_up(communicator, places_.size(), std::move(leaves), std::move(places));
}

void GhostExchange::begin(const double* x, const double* v, const double* a, NodeMotion* ghosts,
                          bodies::RotationState* rotations) {
  if (alone_) return;
  const petsc::Timer timer(petsc::Phase::exchange);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    copy_or_zero(nodes_.sent[i].x, x, places_[i], 3);
    copy_or_zero(nodes_.sent[i].v, v, places_[i], 3);
    copy_or_zero(nodes_.sent[i].a, a, places_[i], 3);
  }
  nodes_.begin(ghosts);
  if (!with_bodies_) return;
  for (const auto& [item, place, unknowns] : sent_bodies_) {
    copy_or_zero(rotations_.sent[item].y.data(), x, place, unknowns);
    copy_or_zero(rotations_.sent[item].dy.data(), v, place, unknowns);
    copy_or_zero(rotations_.sent[item].ddy.data(), a, place, unknowns);
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
