#include "cablenet/system/ghosts.hpp"

#include <algorithm>

#include "cablenet/petsc/phase.hpp"

namespace cablenet::system {
namespace {

using petsc::check;

void copy_or_zero(double* to, const double* from, int node) {
  if (from == nullptr)
    std::fill_n(to, 3, 0.0);
  else
    std::copy_n(from + 3 * static_cast<std::ptrdiff_t>(node), 3, to);
}

}   // namespace

GhostExchange::GhostExchange(const partition::LocalNetwork& network, MPI_Comm communicator) : sent_(network.sent) {
  int ranks = 1;
  MPI_Comm_size(communicator, &ranks);
  alone_ = ranks == 1;
  if (alone_) return;
  buffer_.resize(sent_.size());
  std::vector<PetscSFNode> places;
  for (std::size_t i = 0; i < network.ghost_owner.size(); ++i)
    places.push_back({network.ghost_owner[i], network.ghost_place[i]});
  check(PetscSFCreate(communicator, forest_.out()));
  check(PetscSFSetGraph(forest_, static_cast<PetscInt>(sent_.size()), static_cast<PetscInt>(places.size()), nullptr,
                        PETSC_COPY_VALUES, places.data(), PETSC_COPY_VALUES));
  check(PetscSFSetUp(forest_));
  MPI_Type_contiguous(sizeof(NodeMotion) / sizeof(double), MPI_DOUBLE, unit_.out());
  MPI_Type_commit(unit_.out());
}

void GhostExchange::begin(const double* x, const double* v, const double* a, NodeMotion* ghosts) {
  if (alone_) return;
  const petsc::Timer timer(petsc::Phase::exchange);
  for (std::size_t i = 0; i < sent_.size(); ++i) {
    copy_or_zero(buffer_[i].x, x, sent_[i]);
    copy_or_zero(buffer_[i].v, v, sent_[i]);
    copy_or_zero(buffer_[i].a, a, sent_[i]);
  }
  ghosts_ = ghosts;
  check(PetscSFBcastBegin(forest_, unit_, buffer_.data(), ghosts_, MPI_REPLACE));
}

void GhostExchange::end() {
  if (alone_) return;
  const petsc::Timer timer(petsc::Phase::exchange);
  check(PetscSFBcastEnd(forest_, unit_, buffer_.data(), ghosts_, MPI_REPLACE));
}

}   // namespace cablenet::system
