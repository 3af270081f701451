#include "cablenet/partition/local_network.hpp"

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
    add_ghosts();
    add_prescribed();
    add_elements();
    for (const auto& load : network_.loads)
      if (local_of_[at(load.node)] >= 0 && here_.primary[at(local_of_[at(load.node)])])
        here_.loads.push_back({local_of_[at(load.node)], load.mass, load.force});
    here_.materials = network_.materials;
    here_.gravity = network_.gravity;
    here_.elimination = partition_.elimination;
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

  bool is_mine(std::size_t element) const { return partition_.element_owner[element] == rank_; }

  void add_owned() {
    here_.first_number = partition_.first_number[at(rank_)];
    here_.free_nodes = partition_.first_number.back();
    here_.owned = partition_.first_number[at(rank_) + 1] - here_.first_number;
    std::vector<int> in_order(at(here_.owned));
    for (std::size_t node = 0; node < partition_.solver_number.size(); ++node)
      if (partition_.solver_number[node] >= 0 && partition_.node_owner[node] == rank_)
        in_order[at(partition_.solver_number[node] - here_.first_number)] = static_cast<int>(node);
    for (const int node : in_order) add_node(node, true);
  }

  void add_ghosts() {
    for (std::size_t e = 0; e < network_.elements.size(); ++e)
      if (is_mine(e))
        for (const int node : network_.elements[e].node)
          if (partition_.solver_number[at(node)] >= 0 && local_of_[at(node)] < 0) {
            add_node(node, false);
            here_.ghost_number.push_back(partition_.solver_number[at(node)]);
            ++here_.ghosts;
          }
  }

  void add_prescribed() {
    std::vector<bool> touched(network_.position.size(), false);
    for (std::size_t e = 0; e < network_.elements.size(); ++e)
      if (is_mine(e))
        for (const int node : network_.elements[e].node) touched[at(node)] = true;
    for (const auto& held : network_.prescribed) {
      const bool primary = partition_.node_owner[at(held.node)] == rank_;
      if (!primary && !touched[at(held.node)]) continue;
      add_node(held.node, primary);
      here_.prescribed.push_back({local_of_[at(held.node)], held.motion});
    }
  }

  void add_elements() {
    for (std::size_t e = 0; e < network_.elements.size(); ++e) {
      if (!is_mine(e)) continue;
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
  LocalNetwork here_;
};

}   // namespace

LocalNetwork make_local_network(const network::Network& network, const Partition& partition, int rank) {
  return Extraction(network, partition, rank).extract();
}

}   // namespace cablenet::partition
