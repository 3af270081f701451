#include "energy_record.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cablenet::system {

void EnergyRecord::add(const Energies& part) {
  Energies& now = summary_.now;
  const std::array members{&Energies::kinetic, &Energies::strain,     &Energies::gravity,
                           &Energies::work,    &Energies::dissipated, &Energies::damping,
                           &Energies::water,   &Energies::bed,        &Energies::start};
  std::array<double, members.size()> sums{};
  for (std::size_t i = 0; i < members.size(); ++i) sums[i] = part.*members[i];
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, communicator_);
  for (std::size_t i = 0; i < members.size(); ++i) now.*members[i] = sums[i];
  if (summary_.instants++ == 0) first_ = now;
  highest_dissipated_ = std::max(highest_dissipated_, now.dissipated);
  summary_.gained = highest_dissipated_ - now.dissipated;
  summary_.imbalance = std::max(summary_.imbalance, std::abs(now.balance()));
  summary_.moved = std::max({summary_.moved, now.kinetic, std::abs(now.strain - first_.strain),
                             std::abs(now.gravity - first_.gravity), std::abs(now.work), std::abs(now.dissipated),
                             std::abs(now.damping), std::abs(now.water), std::abs(now.bed)});
}

void EnergyRecord::archive(Archive& archive) {
  archive.item("energies.highest", highest_dissipated_);
  archive.item("energies.first strain", first_.strain);
  archive.item("energies.first gravity", first_.gravity);
  archive.item("energies.moved", summary_.moved);
  archive.item("energies.imbalance", summary_.imbalance);
  archive.item("energies.instants", summary_.instants);
}

void EnergyLooks::add(Energies part) {
  if (!std::exchange(has_begun_, true)) start_ = part.total();
  part.start = start_;
  part.dissipated = start_ - part.total();
  record_.add(part);
}

void EnergyLooks::archive(Archive& archive) {
  record_.archive(archive);
  archive.item("looks.begun", has_begun_);
  archive.item("looks.start", start_);
}

}   // namespace cablenet::system
