#include "cablenet/partition/local_network.hpp"

#include <algorithm>

namespace cablenet::partition {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// Numbers this rank's nodes; local_of[scene node] is -1 where the node is not here.
class Extraction {
public:
  Extraction(const network::Network& network, const Partition& partition, int rank)
      : network_(network), partition_(partition), rank_(rank), local_of_(network.position.size(), -1) {}

  LocalNetwork extract() {
    add_owned();
    find_elements();
    add_ghosts();
    add_prescribed();
    for (const auto* group : {&inner_, &rim_, &copies_}) add_elements(*group);
    here_.inner_elements = static_cast<int>(inner_.size());
    here_.own_elements = static_cast<int>(inner_.size() + rim_.size());
    for (const auto& load : network_.loads)
      if (local_of_[at(load.node)] >= 0 && here_.primary[at(local_of_[at(load.node)])])
        here_.loads.push_back({local_of_[at(load.node)], load.mass, load.force});
    here_.materials = network_.materials;
    here_.gravity = network_.gravity;
    here_.blocks = partition_.blocks;
    here_.interface = partition_.interface;
    return std::move(here_);
  }

private:
  void add_node(int node, bool primary) {
    local_of_[at(node)] = here_.nodes++;
    here_.scene_node.push_back(node);
    here_.primary.push_back(primary);
    here_.position.push_back(network_.position[at(node)]);
    here_.velocity.push_back(network_.velocity[at(node)]);
  }

  /// Calls visit(node) for each element's free ends on other ranks than its other end.
  template <class Visit>
  void for_each_cut_end(Visit&& visit) const {
    for (const auto& element : network_.elements) {
      const auto [a, b] = element.node;
      if (partition_.solver_number[at(a)] < 0 || partition_.solver_number[at(b)] < 0) continue;
      if (partition_.node_owner[at(a)] == partition_.node_owner[at(b)]) continue;
      visit(a);
      visit(b);
    }
  }

  void add_owned() {
    here_.first_number = partition_.first_number[at(rank_)];
    here_.free_nodes = partition_.first_number.back();
    here_.owned = partition_.first_number[at(rank_) + 1] - here_.first_number;
    std::vector<int> in_order(at(here_.owned));
    for (std::size_t node = 0; node < partition_.solver_number.size(); ++node)
      if (partition_.solver_number[node] >= 0 && partition_.node_owner[node] == rank_)
        in_order[at(partition_.solver_number[node] - here_.first_number)] = static_cast<int>(node);
    for (const int node : in_order) add_node(node, true);
    here_.interior = here_.owned;
    for (const int number : partition_.interface.number)
      if (number >= here_.first_number && number < here_.first_number + here_.owned) --here_.interior;
  }

  void find_elements() {
    for (std::size_t e = 0; e < network_.elements.size(); ++e) {
      const auto [a, b] = network_.elements[e].node;
      const int owned = (local_of_[at(a)] >= 0 ? 1 : 0) + (local_of_[at(b)] >= 0 ? 1 : 0);
      const bool mine = partition_.element_owner[e] == rank_;
      if (owned > 0 || mine) (owned == 2 ? inner_ : mine ? rim_ : copies_).push_back(e);
    }
    // In the order of their nodes, so that the loop over elements walks through memory.
    std::stable_sort(inner_.begin(), inner_.end(),
                     [this](std::size_t e, std::size_t f) { return first_node(e) < first_node(f); });
  }

  int first_node(std::size_t e) const {
    const auto [a, b] = network_.elements[e].node;
    return std::min(local_of_[at(a)], local_of_[at(b)]);
  }

  void add_ghosts() {
    for (const auto* group : {&rim_, &copies_})
      for (const std::size_t e : *group)
        for (const int node : network_.elements[e].node)
          if (partition_.solver_number[at(node)] >= 0 && local_of_[at(node)] < 0) {
            add_node(node, false);
            here_.ghost_number.push_back(partition_.solver_number[at(node)]);
            here_.ghost_owner.push_back(partition_.node_owner[at(node)]);
            ++here_.ghosts;
          }
    place_sent_nodes();
  }

  /// Each rank lists the nodes that it sends by their numbers, so that every rank can tell a ghost's place.
  void place_sent_nodes() {
    std::vector<int> sent;
    for_each_cut_end([&](int node) { sent.push_back(partition_.solver_number[at(node)]); });
    std::sort(sent.begin(), sent.end());
    sent.erase(std::unique(sent.begin(), sent.end()), sent.end());
    const auto place = [&](int number) {
      return static_cast<int>(std::lower_bound(sent.begin(), sent.end(), number) - sent.begin());
    };
    const auto& first = partition_.first_number;
    for (std::size_t g = 0; g < here_.ghost_number.size(); ++g)
      here_.ghost_place.push_back(place(here_.ghost_number[g]) - place(first[at(here_.ghost_owner[g])]));
    for (int i = place(first[at(rank_)]); i < place(first[at(rank_) + 1]); ++i)
      here_.sent.push_back(sent[at(i)] - here_.first_number);
  }

  void add_prescribed() {
    std::vector<bool> touched(network_.position.size(), false);
    for (const std::size_t e : rim_)
      for (const int node : network_.elements[e].node) touched[at(node)] = true;
    for (const auto& held : network_.prescribed) {
      const bool primary = partition_.node_owner[at(held.node)] == rank_;
      if (!primary && !touched[at(held.node)]) continue;
      add_node(held.node, primary);
      here_.prescribed.push_back({local_of_[at(held.node)], held.motion});
    }
  }

  void add_elements(const std::vector<std::size_t>& group) {
    for (const std::size_t e : group) {
      const auto& element = network_.elements[e];
      here_.elements.push_back(
          {{local_of_[at(element.node[0])], local_of_[at(element.node[1])]}, element.material, element.length});
      here_.scene_element.push_back(static_cast<int>(e));
    }
  }

  const network::Network& network_;
  const Partition& partition_;
  int rank_;
  std::vector<int> local_of_;
  std::vector<std::size_t> inner_, rim_, copies_;   ///< elements: between owned nodes, other own ones, another rank's
  LocalNetwork here_;
};

}   // namespace

LocalNetwork make_local_network(const network::Network& network, const Partition& partition, int rank) {
  return Extraction(network, partition, rank).extract();
}

}   // namespace cablenet::partition
