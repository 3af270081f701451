#include "cablenet/solve/bed_lay.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <map>

namespace cablenet::solve {
namespace {

/// An element whose chord is this part of its unstretched length, or less, is drawn slack, and lies so.
constexpr double slack = 0.95;

/// What is drawn no higher above the bed than this, over its diameter, and no deeper, is drawn on it.  So is what is no
/// deeper than so many times the smoothing.
constexpr double drawn_height = 1, smoothings = 10;

/// An element on the bed, with what it says of its ends.
struct Lying {
  std::array<double, 2> node;   ///< in the scene's numbers
  double way[2];                ///< from the first end to the second, not stretched [m]
  double is_held[2];            ///< the ends are prescribed
  double place[2][2];           ///< of the ends that are [m]
};

class Lay {
public:
  Lay(const partition::LocalNetwork& network, const Table<LocalNode, Vector3>& drawn,
      const system::LocalState& equilibrium)
      : network_(network), drawn_(drawn), equilibrium_(equilibrium), laid_(network.nodes) {}

  system::GripPlaces make(MPI_Comm communicator) {
    std::vector<Lying> here;
    for (std::size_t i = 0; i < network_.elements.size(); ++i) look_at(i, here);
    for (const auto& spot : network_.bed_spots) look_at(spot);
    spread(gather(here, communicator));
    return std::move(laid_);
  }

private:
  /// Those of other ranks tell where their nodes are drawn, and are laid there.
  void look_at(std::size_t index, std::vector<Lying>& here) {
    const partition::LocalElement& e = network_.elements[index];
    const network::CableOnBed& cable = network_.surroundings.on_bed[at(e.material)];
    const double level = network_.surroundings.bed->level, high = drawn_height * cable.diameter;
    const double deep = std::max(high, smoothings * cable.smoothing);
    std::array<bool, 2> is_drawn, lies;
    for (std::size_t k = 0; k < 2; ++k) {
      const double height = drawn_[e.node[k]].z() - level;
      is_drawn[k] = -deep <= height && height <= high;
      lies[k] = equilibrium_.position(e.node[k]).z() <= level + cable.smoothing;
    }
    const bool takes_drawn = is_drawn[0] && is_drawn[1];
    for (std::size_t k = 0; k < 2; ++k) {
      if (takes_drawn)
        laid_[e.node[k]] = drawn_[e.node[k]];
      else if (lies[k] && !laid_[e.node[k]])
        laid_[e.node[k]] = equilibrium_.position(e.node[k]);
    }
    if (at(network_.own_elements) <= index || !(takes_drawn || (lies[0] && lies[1]))) return;
    const Vector3 chord = takes_drawn ? Vector3(drawn_[e.node[1]] - drawn_[e.node[0]])
                                      : Vector3(equilibrium_.position(e.node[1]) - equilibrium_.position(e.node[0]));
    const double share = e.length / chord.norm();
    here.push_back(lying(e, (share < 1 / slack ? share : 1) * chord));
  }

  void look_at(const network::BedSpot<LocalNode>& spot) {
    const double touched = network_.surroundings.bed->level + spot.radius + spot.smoothing;
    if (equilibrium_.position(spot.node).z() > touched) return;
    const bool is_drawn = drawn_[spot.node].z() <= touched;
    laid_[spot.node] = is_drawn ? drawn_[spot.node] : Vector3(equilibrium_.position(spot.node));
  }

  Lying lying(const partition::LocalElement& e, const Vector3& way) const {
    Lying result{{}, {way.x(), way.y()}, {}, {}};
    for (std::size_t k = 0; k < 2; ++k) {
      const LocalNode node = e.node[k];
      const bool is_held = !network_.is_free(node) && !network_.is_carried(node);
      result.node[k] = network_.scene_node[node].value();
      result.is_held[k] = is_held ? 1 : 0;
      for (int i = 0; i < 2; ++i) result.place[k][i] = equilibrium_.position(node)(i);
    }
    return result;
  }

  static std::vector<Lying> gather(const std::vector<Lying>& here, MPI_Comm communicator) {
    constexpr int width = sizeof(Lying) / sizeof(double);
    int ranks = 1;
    MPI_Comm_size(communicator, &ranks);
    const int count = width * static_cast<int>(here.size());
    std::vector<int> counts(at(ranks)), begins(at(ranks), 0);
    MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, communicator);
    for (std::size_t i = 1; i < counts.size(); ++i) begins[i] = begins[i - 1] + counts[i - 1];
    std::vector<Lying> all(at((begins.back() + counts.back()) / width));
    MPI_Allgatherv(here.data(), count, MPI_DOUBLE, all.data(), counts.data(), begins.data(), MPI_DOUBLE, communicator);
    return all;
  }

  /// Goes from the held nodes on, nearest neighbours first.
  void spread(const std::vector<Lying>& all) {
    std::multimap<int, std::pair<int, Vector3>> next;
    std::map<int, Vector3> place;
    for (const Lying& element : all) {
      const Vector3 way(element.way[0], element.way[1], 0);
      const int a = static_cast<int>(element.node[0]), b = static_cast<int>(element.node[1]);
      next.insert({a, {b, way}});
      next.insert({b, {a, -way}});
      for (std::size_t k = 0; k < 2; ++k)
        if (element.is_held[k] > 0)
          place[static_cast<int>(element.node[k])] = {element.place[k][0], element.place[k][1], 0};
    }
    std::deque<int> ends;
    for (const auto& [node, where] : place) ends.push_back(node);
    for (; !ends.empty(); ends.pop_front()) {
      const auto [first, last] = next.equal_range(ends.front());
      for (auto found = first; found != last; ++found) {
        const auto& [node, way] = found->second;
        if (place.insert({node, place[ends.front()] + way}).second) ends.push_back(node);
      }
    }
    for (LocalNode node(0); node.value() < network_.nodes; ++node)
      if (const auto found = place.find(network_.scene_node[node].value()); found != place.end())
        laid_[node] = found->second;
  }

  const partition::LocalNetwork& network_;
  const Table<LocalNode, Vector3>& drawn_;
  const system::LocalState& equilibrium_;
  system::GripPlaces laid_;
};

}   // namespace

system::GripPlaces laid_on_bed(const partition::LocalNetwork& network, const Table<LocalNode, Vector3>& drawn,
                               const system::LocalState& equilibrium, MPI_Comm communicator) {
  return Lay(network, drawn, equilibrium).make(communicator);
}

}   // namespace cablenet::solve
