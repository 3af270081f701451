#include "cablenet/partition/local_network.hpp"

#include <algorithm>
#include <unordered_set>

namespace cablenet::partition {
namespace {

/// Extracts a rank's share of the network.  local_of_[scene node] is none where the node is not on this rank.
class Extraction {
public:
  Extraction(const network::Network& network, const Partition& partition, int rank)
      : network_(network), partition_(partition), rank_(rank), local_of_(network.position.size()) {
    if (network.carried.empty()) return;
    anchor_.resize(network.position.size());
    for (SceneNode node(0); node.value() < anchor_.size(); ++node) anchor_[node] = node;
    for (const auto& carried : network.carried) anchor_[carried.node] = network.bodies[at(carried.body)].node;
  }

  LocalNetwork extract() {
    here_.blocks = partition_.blocks;
    here_.extent = network_.extent();
    add_owned();
    find_elements();
    find_links();
    add_ghosts();
    add_prescribed();
    add_bodies();
    for (const auto* group : {&inner_, &rim_, &attached_, &attached_copies_, &copies_}) add_elements(*group);
    for (const auto& [node, stiffness, bar_length] : links_)
      here_.links.push_back({{local_of_[node[0]], local_of_[node[1]]}, stiffness, bar_length});
    here_.inner_elements = static_cast<int>(inner_.size());
    here_.attached.first = here_.inner_elements + static_cast<int>(rim_.size());
    here_.own_elements = here_.attached.first + static_cast<int>(attached_.size());
    here_.attached.last = here_.own_elements + static_cast<int>(attached_copies_.size());
    for (const auto& load : network_.loads)
      if (const LocalNode node = local_of_[load.node]; speaks_for(node))
        here_.loads.push_back({node, load.mass, load.force});
    for (std::size_t i = 0; i < network_.points.size(); ++i)
      if (const LocalNode node = local_of_[network_.point_node[i]]; speaks_for(node))
        here_.points.push_back({node, network_.points[i]});
    for (const auto& point : network_.wet_points)
      if (const LocalNode node = local_of_[point.node]; speaks_for(node))
        here_.wet_points.push_back({node, point.water});
    for (const auto& spot : network_.bed_spots)
      if (const LocalNode node = local_of_[spot.node]; speaks_for(node))
        here_.bed_spots.push_back(
            {node, spot.radius, spot.area, spot.smoothing, spot.friction_stiffness, spot.friction_delay});
    here_.materials = network_.materials;
    here_.surroundings = network_.surroundings;
    here_.gravity = network_.gravity;
    here_.interface = partition_.interface;
    return std::move(here_);
  }

private:
  /// The node whose unknowns move this one.
  SceneNode anchor(SceneNode node) const { return anchor_.empty() ? node : anchor_[node]; }
  bool is_carried(SceneNode node) const { return anchor(node) != node; }
  bool is_owned(SceneNode node) const { return local_of_[anchor(node)].exists(); }
  bool speaks_for(LocalNode node) const { return node.exists() && here_.primary[node]; }
  bool is_free(SceneNode node) const { return partition_.solver_number[node].exists(); }

  void add_node(SceneNode node, bool primary) {
    local_of_[node] = LocalNode(here_.nodes++);
    here_.scene_node.push_back(node);
    here_.primary.push_back(primary);
    here_.position.push_back(network_.position[node]);
    here_.velocity.push_back(network_.velocity[node]);
  }

  /// Calls visit(node) for both ends of each element or link whose ends are free and belong to two ranks.
  template <class Visit>
  void for_each_cut_end(Visit&& visit) const {
    const auto visit_ends = [&](SceneNode a, SceneNode b) {
      if (!is_free(a) || !is_free(b)) return;
      if (partition_.node_owner[a] == partition_.node_owner[b]) return;
      visit(a);
      visit(b);
    };
    for (const auto& element : network_.elements) visit_ends(element.node[0], element.node[1]);
    for (const auto& link : network_.links) visit_ends(link.node[0], link.node[1]);
  }

  void add_owned() {
    here_.first_number = partition_.first_number[at(rank_)];
    here_.free_nodes = partition_.first_number.back().value();
    here_.owned = partition_.first_number[at(rank_) + 1] - here_.first_number;
    std::vector<SceneNode> in_order(at(here_.owned));
    for (SceneNode node(0); node.value() < network_.position.size(); ++node)
      if (is_free(node) && partition_.node_owner[node] == rank_ && !is_carried(node))
        in_order[at(partition_.solver_number[node] - here_.first_number)] = node;
    for (const SceneNode node : in_order) add_node(node, true);
    const int begin = here_.blocks.begin(here_.first_number);
    for (int i = 0; i <= here_.owned; ++i)
      here_.begin.push_back(Unknown(here_.blocks.begin(here_.first_number + i) - begin));
    here_.interior = here_.owned;
    for (const SolverNumber number : partition_.interface.number)
      if (number >= here_.first_number && number < here_.first_number + here_.owned) --here_.interior;
  }

  void find_elements() {
    for (std::size_t e = 0; e < network_.elements.size(); ++e) {
      const auto [a, b] = network_.elements[e].node;
      const int owned = (is_owned(a) ? 1 : 0) + (is_owned(b) ? 1 : 0);
      const bool mine = partition_.element_owner[e] == rank_;
      if (owned == 0 && !mine) continue;
      if (is_carried(a) || is_carried(b))
        (mine ? attached_ : attached_copies_).push_back(e);
      else
        (owned == 2 ? inner_ : mine ? rim_ : copies_).push_back(e);
    }
    // Elements are in the order of their nodes, so that the loop over elements walks through memory.
    std::stable_sort(inner_.begin(), inner_.end(),
                     [this](std::size_t e, std::size_t f) { return first_node(e) < first_node(f); });
  }

  void find_links() {
    for (const bool own : {true, false})
      for (const auto& link : network_.links)
        if (is_owned(link.node[0]) == own && (own || is_owned(link.node[1]))) links_.push_back(link);
    here_.own_links = static_cast<int>(
        std::count_if(links_.begin(), links_.end(), [this](const auto& link) { return is_owned(link.node[0]); }));
  }

  LocalNode first_node(std::size_t e) const {
    const auto [a, b] = network_.elements[e].node;
    return std::min(local_of_[a], local_of_[b]);
  }

  void add_ghosts() {
    const auto add = [this](SceneNode carried_or_not) {
      const SceneNode node = anchor(carried_or_not);
      if (!is_free(node) || local_of_[node].exists()) return;
      add_node(node, false);
      here_.ghost_number.push_back(partition_.solver_number[node]);
      here_.ghost_owner.push_back(partition_.node_owner[node]);
      ++here_.ghosts;
    };
    for (const auto* group : {&rim_, &attached_, &attached_copies_, &copies_})
      for (const std::size_t e : *group)
        for (const SceneNode node : network_.elements[e].node) add(node);
    for (const auto& link : links_)
      for (const SceneNode node : link.node) add(node);
    list_sent_nodes();
  }

  /// A rank lists the nodes that it sends in the order of their solver numbers.  So every rank can tell at which index
  /// a ghost stands in its owner's list.
  void list_sent_nodes() {
    std::vector<SolverNumber> sent;
    for_each_cut_end([&](SceneNode node) { sent.push_back(partition_.solver_number[node]); });
    std::sort(sent.begin(), sent.end());
    sent.erase(std::unique(sent.begin(), sent.end()), sent.end());
    const auto index = [&](SolverNumber number) {
      return static_cast<int>(std::lower_bound(sent.begin(), sent.end(), number) - sent.begin());
    };
    const auto& first = partition_.first_number;
    for (std::size_t g = 0; g < here_.ghost_number.size(); ++g)
      here_.ghost_index.push_back(index(here_.ghost_number[g]) - index(first[at(here_.ghost_owner[g])]));
    for (int i = index(first[at(rank_)]); i < index(first[at(rank_) + 1]); ++i)
      here_.sent.emplace_back(sent[at(i)] - here_.first_number);
  }

  void add_prescribed() {
    Table<SceneNode, bool> touched(network_.position.size(), false);
    for (const auto* group : {&rim_, &attached_})
      for (const std::size_t e : *group)
        for (const SceneNode node : network_.elements[e].node) touched[node] = true;
    for (const auto& held : network_.prescribed) {
      const bool primary = partition_.node_owner[held.node] == rank_;
      if (!primary && !touched[held.node]) continue;
      add_node(held.node, primary);
      here_.prescribed.push_back({local_of_[held.node], held.motion});
    }
  }

  /// If a body belongs to another rank, only its carried nodes at elements and links of this rank are here.
  void add_bodies() {
    std::unordered_set<SceneNode> touched;
    for (const auto* group : {&attached_, &attached_copies_})
      for (const std::size_t e : *group)
        touched.insert(network_.elements[e].node.begin(), network_.elements[e].node.end());
    for (const auto& link : links_) touched.insert(link.node[1]);
    here_.has_euler_bodies = std::any_of(network_.bodies.begin(), network_.bodies.end(), [](const auto& body) {
      return body.properties.rotation == bodies::Rotation::euler;
    });
    for (const bool own : {true, false})
      for (std::size_t b = 0; b < network_.bodies.size(); ++b)
        if (const LocalNode node = local_of_[network_.bodies[b].node]; node.exists() && here_.is_owned(node) == own)
          add_body(static_cast<int>(b), node, touched);
  }

  void add_body(int index, LocalNode node, const std::unordered_set<SceneNode>& touched) {
    const network::Body& body = network_.bodies[at(index)];
    const bool own = here_.is_owned(node);
    const int first_carried = static_cast<int>(here_.carried.size());
    LocalBody local{node, index, body.properties, body.start, body.water, first_carried, 0, body.reach};
    for (int k = body.first_carried; k < body.first_carried + body.carried; ++k) {
      const network::CarriedNode& carried = network_.carried[at(k)];
      if (!own && !touched.contains(carried.node)) continue;
      add_node(carried.node, own);
      here_.carried.push_back({local_of_[carried.node], static_cast<int>(here_.bodies.size()), carried.offset});
      ++local.carried;
    }
    if (own) ++here_.own_bodies;
    here_.bodies.push_back(local);
  }

  void add_elements(const std::vector<std::size_t>& group) {
    const auto unknown = [this](LocalNode node) { return here_.is_owned(node) ? here_.begin[node] : Unknown(); };
    for (const std::size_t e : group) {
      const auto& element = network_.elements[e];
      const LocalNode a = local_of_[element.node[0]], b = local_of_[element.node[1]];
      here_.elements.push_back({{a, b}, {unknown(a), unknown(b)}, element.material, element.length});
      here_.scene_element.push_back(static_cast<int>(e));
    }
  }

  const network::Network& network_;
  const Partition& partition_;
  int rank_;
  Table<SceneNode, LocalNode> local_of_;
  Table<SceneNode, SceneNode> anchor_;              ///< empty if no node is carried
  std::vector<std::size_t> inner_, rim_, copies_;   ///< elements: between owned nodes, other own ones, other ranks'
  std::vector<std::size_t> attached_, attached_copies_;   ///< elements at carried nodes: own ones, other ranks'
  std::vector<network::Link<SceneNode>> links_;
  LocalNetwork here_;
};

}   // namespace

LocalNetwork make_local_network(const network::Network& network, const Partition& partition, int rank) {
  return Extraction(network, partition, rank).extract();
}

}   // namespace cablenet::partition
