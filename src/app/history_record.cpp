#include "history_record.hpp"

#include <algorithm>
#include <cmath>

namespace cablenet::app {
namespace {

/// A cable's bends are told in so many parts.
constexpr std::size_t parts = 32;

scene::Scene judged(scene::Scene scene) {
  auto& items = scene.output.history;
  if (!items.empty()) return scene;
  using scene::HistoryKind;
  for (int i = 0; i < std::ssize(scene.points); ++i) items.push_back({HistoryKind::point, i});
  for (int i = 0; i < std::ssize(scene.bodies); ++i) items.push_back({HistoryKind::body, i});
  for (int i = 0; i < std::ssize(scene.cables); ++i) items.push_back({HistoryKind::cable, i});
  return scene;
}

}   // namespace

HistoryRecord::HistoryRecord(const scene::Scene& scene, const network::Network& network,
                             const system::Assembler& assembler)
    : network_(network),
      assembler_(assembler),
      probes_(judged(scene), network, assembler),
      turns_(network.elements.size(), 0) {}

void HistoryRecord::look(const system::LocalState& state) {
  rows_.push_back(probes_.row(state));
  const partition::LocalNetwork& here = assembler_.network();
  std::vector<double> chords(3 * network_.elements.size(), 0);
  for (int i = 0; i < here.own_elements; ++i) {
    const partition::LocalElement& element = here.elements[at(i)];
    const Vector3 chord = state.position(element.node[1]) - state.position(element.node[0]);
    for (int k = 0; k < 3; ++k) chords[3 * at(here.scene_element[at(i)]) + at(k)] = chord(k);
  }
  MPI_Allreduce(MPI_IN_PLACE, chords.data(), static_cast<int>(chords.size()), MPI_DOUBLE, MPI_SUM,
                assembler_.communicator());
  const auto chord = [&](int e) { return Eigen::Map<const Vector3>(chords.data() + 3 * at(e)); };
  for (const network::Span& span : network_.spans)
    for (int e = span.first_element; e + 1 < span.first_element + span.elements; ++e) {
      const Vector3 turn = chord(e + 1).normalized() - chord(e).normalized();
      const double length = (network_.elements[at(e)].length + network_.elements[at(e + 1)].length) / 2;
      turns_[at(e)] += turn.squaredNorm() / (length * length);
    }
}

accuracy::HistoryTable HistoryRecord::table() const {
  accuracy::HistoryTable table{probes_.columns(), rows_};
  for (auto& row : table.rows)
    MPI_Bcast(row.data(), static_cast<int>(row.size()), MPI_DOUBLE, 0, assembler_.communicator());
  return table;
}

std::vector<accuracy::Bending> HistoryRecord::bends() const {
  std::vector<accuracy::Bending> all;
  const double looks = static_cast<double>(std::max<std::size_t>(rows_.size(), 1));
  for (const network::Span& span : network_.spans) {
    // Piecewise linear between nodes, the ends as their neighbours.
    std::vector<double> arcs, values;
    double arc = 0;
    for (int e = span.first_element; e + 1 < span.first_element + span.elements; ++e) {
      arc += network_.elements[at(e)].length;
      arcs.push_back(arc);
      values.push_back(std::sqrt(turns_[at(e)] / looks));
    }
    arc += network_.elements[at(span.first_element + span.elements - 1)].length;
    std::vector<double> bends(parts, 0);
    std::size_t next = 0;
    for (std::size_t p = 0; p < parts && !arcs.empty(); ++p) {
      const double s = arc * (static_cast<double>(p) + 0.5) / static_cast<double>(parts);
      while (next < arcs.size() && arcs[next] < s) ++next;
      if (next == 0 || next == arcs.size()) {
        bends[p] = next == 0 ? values.front() : values.back();
        continue;
      }
      const double share = (s - arcs[next - 1]) / (arcs[next] - arcs[next - 1]);
      bends[p] = values[next - 1] + share * (values[next] - values[next - 1]);
    }
    all.push_back({arc, std::move(bends)});
  }
  return all;
}

}   // namespace cablenet::app
