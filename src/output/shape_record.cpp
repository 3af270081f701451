#include "cablenet/output/shape_record.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace cablenet::output {
namespace {

constexpr double far = std::numeric_limits<double>::max();

/// The angle between two attitudes.  [rad]
double angle_between(const Quaternion& a, const Quaternion& b) {
  const Quaternion turn = a.conjugate() * b;
  return 2 * std::atan2(turn.vec().norm(), std::abs(turn.w()));
}

void all_reduce(std::vector<double>& values, MPI_Op operation, MPI_Comm communicator) {
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, operation, communicator);
}

/// So many instants are all looked at; of those after them every second one, so that it costs less than 1 % even where
/// all steps are written.
constexpr long looks_at_all = 64;

/// What is summed over ranks for each cable.
enum Kind { nodes, sag, bending, motion, strain, elements, jump, wobble, kinds };

double root(double sum, double count) { return count > 0 ? std::sqrt(std::max(0.0, sum / count)) : 0; }

}   // namespace

ShapeRecord::ShapeRecord(const network::Network& network, std::size_t cables, const partition::LocalNetwork& here,
                         MPI_Comm communicator)
    : here_(here),
      communicator_(communicator),
      ends_(6 * cables),
      lines_(cables),
      chords_(here.elements.size()),
      strains_(here.elements.size()),
      sums_(cables, {0, 0, 0, -far, far}),
      turned_(network.bodies.size(), 0),
      highest_(-far),
      lowest_(far) {
  for (const int element : here.scene_element) cable_of_.push_back(network.span_at(element));
  for (const network::Body& body : network.bodies) drawn_.push_back(body.properties.attitude);
  find_inner_nodes(network);
  find_ends(network);
}

void ShapeRecord::find_inner_nodes(const network::Network& network) {
  struct Neighbours {
    int count = 0, before = -1, after = -1;
  };
  std::vector<Neighbours> at_node(at(here_.owned));
  for (std::size_t i = 0; i < here_.elements.size(); ++i)
    for (std::size_t side = 0; side < 2; ++side) {
      const LocalNode node = here_.elements[i].node[side];
      if (!here_.is_owned(node)) continue;
      ++at_node[at(node)].count;
      (side == 0 ? at_node[at(node)].after : at_node[at(node)].before) = static_cast<int>(i);
    }
  for (LocalNode node(0); here_.is_owned(node); ++node) {
    const auto [count, before, after] = at_node[at(node)];
    if (count != 2 || before < 0 || after < 0) continue;
    const std::size_t cable = cable_of_[at(before)];
    const int first = here_.scene_element[at(before)], second = here_.scene_element[at(after)];
    if (cable >= sums_.size() || cable != network.span_at(second) || second != first + 1) continue;
    inner_.push_back({node, before, after, cable, Vector3::Zero()});
  }
}

void ShapeRecord::find_ends(const network::Network& network) {
  std::multimap<SceneNode, std::size_t> places;
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    const network::Span& span = network.spans[i];
    places.emplace(network.elements[at(span.first_element)].node[0], 2 * i);
    places.emplace(network.elements[at(span.first_element + span.elements - 1)].node[1], 2 * i + 1);
  }
  for (LocalNode node(0); node.value() < here_.nodes; ++node) {
    if (!here_.primary[node]) continue;
    const auto [begin, end] = places.equal_range(here_.scene_node[node]);
    for (auto it = begin; it != end; ++it) own_ends_.push_back({node, it->second});
  }
}

void ShapeRecord::look(const system::LocalState& state) {
  if (++shown_ > looks_at_all && shown_ % 2 == 0) return;
  std::fill(ends_.begin(), ends_.end(), 0.0);
  for (const End& end : own_ends_) {
    const Vector3 x = state.position(end.node);
    std::copy(x.begin(), x.end(), ends_.begin() + static_cast<std::ptrdiff_t>(3 * end.place));
  }
  int ranks = 1;
  MPI_Comm_size(communicator_, &ranks);
  if (ranks > 1) all_reduce(ends_, MPI_SUM, communicator_);
  for (std::size_t i = 0; i < lines_.size(); ++i) lines_[i] = (end(2 * i + 1) - end(2 * i)).stableNormalized();
  look_at_elements(state);
  for (Inner& inner : inner_) look_at_node(inner, state);
  look_at_bodies(state);
  for (LocalNode node(0); node.value() < here_.nodes; ++node) {
    const double z = state.x[3 * at(node) + 2];
    highest_ = std::max(highest_, z);
    lowest_ = std::min(lowest_, z);
  }
  ++instants_;
}

void ShapeRecord::look_at_elements(const system::LocalState& state) {
  for (std::size_t i = 0; i < here_.elements.size(); ++i) {
    if (cable_of_[i] >= sums_.size()) continue;
    const partition::LocalElement& element = here_.elements[i];
    const Vector3 d = state.position(element.node[1]) - state.position(element.node[0]);
    const double l = d.norm();
    chords_[i] = {l > 0 ? Vector3(d / l) : Vector3(Vector3::Zero()), l};
    strains_[i] = l / element.length - 1;
    if (i >= at(here_.own_elements)) continue;
    Sums& sums = sums_[cable_of_[i]];
    sums.strain += strains_[i] * strains_[i];
    ++sums.elements;
    for (const LocalNode node : element.node) {
      const double z = state.x[3 * at(node) + 2];
      sums.highest = std::max(sums.highest, z);
      sums.lowest = std::min(sums.lowest, z);
    }
  }
}

void ShapeRecord::look_at_node(Inner& inner, const system::LocalState& state) {
  Sums& sums = sums_[inner.cable];
  const auto before = at(inner.before), after = at(inner.after);
  // The angle by its chord: the two differ by a part of theta^2/24.
  const Vector3 sag =
      (chords_[before].length + chords_[after].length) / 16 * (chords_[after].direction - chords_[before].direction);
  inner.sags += sag;
  inner.squared_sags += sag.squaredNorm();
  const Vector3 from_end = state.position(inner.node) - end(2 * inner.cable);
  const Vector3& line = lines_[inner.cable];
  // Where both ends are in one place there is no line, but that place.
  sums.deviation = std::max(sums.deviation, (from_end - from_end.dot(line) * line).squaredNorm());
  if (instants_ == 0) inner.first = from_end;
  const Vector3 way = from_end - inner.first;
  inner.sum += way;
  inner.squares += way.squaredNorm();
  const double rise = strains_[after] - strains_[before];
  inner.jumps += rise;
  inner.squared_jumps += rise * rise;
}

void ShapeRecord::look_at_bodies(const system::LocalState& state) {
  for (std::size_t b = 0; b < at(here_.own_bodies); ++b) {
    const std::size_t body = at(here_.bodies[b].body);
    turned_[body] = std::max(turned_[body], angle_between(drawn_[body], state.bodies[b].attitude));
  }
}

/// Per cable the sums of `Kind`, on all ranks.
std::vector<double> ShapeRecord::sums() const {
  const auto instants = static_cast<double>(instants_);
  std::vector<double> sums(kinds * sums_.size(), 0);
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    sums[kinds * i + strain] = sums_[i].strain;
    sums[kinds * i + elements] = sums_[i].elements;
  }
  for (const Inner& inner : inner_) {
    double* const of = &sums[kinds * inner.cable];
    of[nodes] += 1;
    of[sag] += inner.squared_sags;
    of[bending] += inner.squared_sags - inner.sags.squaredNorm() / instants;
    of[motion] += inner.squares - inner.sum.squaredNorm() / instants;
    of[jump] += inner.squared_jumps;
    of[wobble] += inner.squared_jumps - inner.jumps * inner.jumps / instants;
  }
  all_reduce(sums, MPI_SUM, communicator_);
  return sums;
}

ShapeSummary ShapeRecord::summary() const {
  const std::size_t cables = sums_.size();
  const std::vector<double> sums = this->sums();
  std::vector<double> most{highest_, -lowest_};
  for (const Sums& one : sums_) most.insert(most.end(), {std::sqrt(one.deviation), one.highest, -one.lowest});
  all_reduce(most, MPI_MAX, communicator_);
  ShapeSummary summary{{}, turned_, most[0], -most[1], instants_};
  all_reduce(summary.turned, MPI_MAX, communicator_);
  for (std::size_t i = 0; i < cables; ++i) {
    const double* const of = &sums[kinds * i];
    const double* const extremes = &most[2 + 3 * i];
    const double looks = of[nodes] * static_cast<double>(instants_);
    const auto mean = [&](Kind kind) { return root(of[kind], kind == strain ? of[elements] : looks); };
    summary.cables.push_back({std::lround(of[nodes]), mean(sag), mean(bending), mean(motion), extremes[0], mean(strain),
                              mean(jump), mean(wobble), extremes[1], -extremes[2]});
  }
  return summary;
}

}   // namespace cablenet::output
