#include "static_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

namespace cablenet::app {
namespace {

constexpr std::size_t most_named = 3;

std::string cable_of(const network::Network& network, int element) {
  const std::string name = network.element_name(element);
  return name.substr(0, name.rfind(", element"));
}

/// On the first rank.
template <class T>
std::vector<T> gather(const std::vector<T>& here, MPI_Datatype type, MPI_Comm communicator) {
  int rank = 0, ranks = 1, count = static_cast<int>(here.size());
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &ranks);
  std::vector<int> counts(static_cast<std::size_t>(ranks)), begins(counts.size());
  MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, communicator);
  int sum = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) begins[i] = sum, sum += rank == 0 ? counts[i] : 0;
  std::vector<T> all(static_cast<std::size_t>(sum));
  MPI_Gatherv(here.data(), count, type, all.data(), counts.data(), begins.data(), type, 0, communicator);
  return all;
}

/// The largest value of each cable or net that has one, on the first rank.
std::map<std::string, double> largest_by_cable(const network::Network& network,
                                               const std::vector<std::pair<int, double>>& here, MPI_Comm communicator) {
  std::vector<int> elements;
  std::vector<double> values;
  for (const auto& [element, value] : here) elements.push_back(element), values.push_back(value);
  elements = gather(elements, MPI_INT, communicator);
  values = gather(values, MPI_DOUBLE, communicator);
  std::map<std::string, double> largest;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    double& most = largest[cable_of(network, elements[i])];
    most = std::max(most, values[i]);
  }
  return largest;
}

}   // namespace

std::string note_of_pushing(const network::Network& network, const std::vector<std::pair<int, double>>& here,
                            MPI_Comm communicator) {
  const std::map<std::string, double> by_cable = largest_by_cable(network, here, communicator);
  if (by_cable.empty()) return {};
  std::vector<std::pair<double, std::string>> sorted;
  for (const auto& [name, force] : by_cable) sorted.emplace_back(force, name);
  std::sort(sorted.rbegin(), sorted.rend());
  std::string text;
  for (std::size_t i = 0; i < std::min(sorted.size(), most_named); ++i)
    text += fmt::format("{}{} with up to {:.3g} N", i == 0 ? "" : ", ", sorted[i].second, sorted[i].first);
  if (sorted.size() > most_named) text += fmt::format(", and {} more", sorted.size() - most_named);
  return fmt::format("in this equilibrium some cables push: {}; tension_only: true excludes that", text);
}

std::string note_of_touchdown(const network::Network& network, const std::vector<std::pair<int, double>>& here,
                              MPI_Comm communicator) {
  std::string names;
  for (const auto& [name, lies] : largest_by_cable(network, here, communicator))
    if (lies == 0) names += (names.empty() ? "" : ", ") + name;
  if (names.empty()) return {};
  return fmt::format("shorter than an element is what lies on the bed of: {}; try more elements", names);
}

}   // namespace cablenet::app
