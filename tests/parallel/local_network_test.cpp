#include "cablenet/partition/local_network.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "../support/networks.hpp"
#include "../support/scenes.hpp"

using namespace cablenet;
using namespace cablenet::test;

namespace {

class LocalNetwork : public testing::TestWithParam<NamedScene> {
protected:
  network::Network network_ = network_of(GetParam().text);
  partition::Partition partition_ = partition::make_partition(network_, PETSC_COMM_WORLD);
  Table<SceneNode, bool> held_ = held_nodes(network_);
  partition::LocalNetwork here_ = partition::make_local_network(network_, partition_, rank_of(PETSC_COMM_WORLD));

  /// How often each index occurs on all ranks together.
  template <class Number>
  std::vector<int> counts(const std::vector<Number>& found, std::size_t size) const {
    std::vector<int> count(size, 0);
    for (const Number index : found) ++count[at(index)];
    MPI_Allreduce(MPI_IN_PLACE, count.data(), static_cast<int>(size), MPI_INT, MPI_SUM, PETSC_COMM_WORLD);
    return count;
  }
};

}   // namespace

TEST_P(LocalNetwork, NumbersNodesByTheirKind) {
  const int rank = rank_of(PETSC_COMM_WORLD);
  EXPECT_EQ(here_.first_number, partition_.first_number[at(rank)]);
  EXPECT_EQ(here_.free_nodes, partition_.first_number.back().value());
  EXPECT_EQ(here_.owned, partition_.first_number[at(rank) + 1] - here_.first_number);
  EXPECT_EQ(here_.nodes, here_.owned + here_.ghosts + static_cast<int>(here_.prescribed.size()));
  EXPECT_EQ(here_.ghost_number.size(), at(here_.ghosts));
  for (const int size : {here_.scene_node.size(), here_.primary.size(), here_.position.size(), here_.velocity.size()})
    EXPECT_EQ(size, here_.nodes);
  EXPECT_EQ(std::set<SceneNode>(here_.scene_node.begin(), here_.scene_node.end()).size(), at(here_.nodes));
  for (LocalNode i(0); i.value() < here_.nodes; ++i) {
    const SceneNode node = here_.scene_node[i];
    EXPECT_EQ(here_.is_free(i), !held_[node]);
    EXPECT_EQ(here_.position[i], network_.position[node]);
    EXPECT_EQ(here_.velocity[i], network_.velocity[node]);
    if (!here_.is_free(i)) continue;
    EXPECT_EQ(here_.number(i), partition_.solver_number[node]);
    EXPECT_EQ(here_.is_owned(i), partition_.node_owner[node] == rank);
  }
}

TEST_P(LocalNetwork, HasItsElementsWithTheirNodes) {
  const int rank = rank_of(PETSC_COMM_WORLD);
  ASSERT_EQ(here_.scene_element.size(), here_.elements.size());
  const std::vector<int> own(here_.scene_element.begin(), here_.scene_element.begin() + here_.own_elements);
  EXPECT_EQ(counts(own, network_.elements.size()), std::vector<int>(network_.elements.size(), 1));
  EXPECT_LE(here_.inner_elements, here_.own_elements);
  for (std::size_t i = 0; i < here_.elements.size(); ++i) {
    const partition::LocalElement& element = here_.elements[i];
    const network::Element& whole = network_.elements[at(here_.scene_element[i])];
    EXPECT_EQ(partition_.element_owner[at(here_.scene_element[i])] == rank, i < at(here_.own_elements));
    EXPECT_EQ(here_.is_owned(element.node[0]) && here_.is_owned(element.node[1]), i < at(here_.inner_elements));
    EXPECT_EQ(element.material, whole.material);
    EXPECT_EQ(element.length, whole.length);
    for (std::size_t side = 0; side < 2; ++side) EXPECT_EQ(here_.scene_node[element.node[side]], whole.node[side]);
  }
}

TEST_P(LocalNetwork, HasAllElementsAtItsOwnNodes) {
  std::set<int> here(here_.scene_element.begin(), here_.scene_element.end());
  EXPECT_EQ(here.size(), here_.scene_element.size());
  for (std::size_t e = 0; e < network_.elements.size(); ++e)
    for (const SceneNode node : network_.elements[e].node)
      EXPECT_TRUE(held_[node] || partition_.node_owner[node] != rank_of(PETSC_COMM_WORLD) ||
                  here.contains(static_cast<int>(e)))
          << "element " << e << " at node " << node.value();
}

TEST_P(LocalNetwork, GhostsStandWhereTheirOwnersSendThem) {
  std::vector<int> sent(here_.sent.size()), count(at(size_of(PETSC_COMM_WORLD)));
  std::transform(here_.sent.begin(), here_.sent.end(), sent.begin(),
                 [&](LocalNode node) { return here_.number(node).value(); });
  const int mine = static_cast<int>(sent.size());
  MPI_Allgather(&mine, 1, MPI_INT, count.data(), 1, MPI_INT, PETSC_COMM_WORLD);
  std::vector<int> begin(count.size() + 1, 0);
  std::partial_sum(count.begin(), count.end(), begin.begin() + 1);
  std::vector<int> all(at(begin.back()));
  MPI_Allgatherv(sent.data(), mine, MPI_INT, all.data(), count.data(), begin.data(), MPI_INT, PETSC_COMM_WORLD);
  ASSERT_EQ(here_.ghost_index.size(), at(here_.ghosts));
  for (std::size_t g = 0; g < here_.ghost_index.size(); ++g)
    EXPECT_EQ(all.at(at(begin[at(here_.ghost_owner[g])] + here_.ghost_index[g])), here_.ghost_number[g].value());
}

TEST_P(LocalNetwork, InteriorsOfDifferentRanksDoNotMeet) {
  const std::set<SolverNumber> shared(here_.interface.number.begin(), here_.interface.number.end());
  for (LocalNode node(0); here_.is_owned(node); ++node)
    EXPECT_EQ(shared.contains(here_.number(node)), node.value() >= here_.interior);
  for (const auto& element : here_.elements)
    for (std::size_t side = 0; side < 2; ++side) {
      const LocalNode ghost = element.node[1 - side];
      if (element.node[side].value() >= here_.interior || here_.is_owned(ghost) || !here_.is_free(ghost)) continue;
      EXPECT_TRUE(shared.contains(here_.number(ghost)));
    }
}

TEST_P(LocalNetwork, NodesLoadsAndHeldNodesAreSpokenForOnce) {
  const std::size_t nodes = at(network_.position.size());
  std::vector<SceneNode> primary, loads, prescribed;
  std::vector<int> expected_loads(nodes, 0);
  for (LocalNode node(0); node.value() < here_.nodes; ++node)
    if (here_.primary[node]) primary.push_back(here_.scene_node[node]);
  for (const auto& load : here_.loads) {
    EXPECT_TRUE(here_.primary[load.node]);
    loads.push_back(here_.scene_node[load.node]);
  }
  for (const auto& load : network_.loads) ++expected_loads[at(load.node)];
  for (const auto& held : here_.prescribed) {
    EXPECT_GE(held.node.value(), here_.owned + here_.ghosts);
    const Vector3 place = held.motion.at(0).x;
    EXPECT_EQ(place, network_.position[here_.scene_node[held.node]]);
    if (here_.primary[held.node]) prescribed.push_back(here_.scene_node[held.node]);
  }
  EXPECT_EQ(counts(primary, nodes), std::vector<int>(nodes, 1));
  EXPECT_EQ(counts(loads, nodes), expected_loads);
  EXPECT_EQ(counts(prescribed, nodes), std::vector<int>(held_.begin(), held_.end()));
}

INSTANTIATE_TEST_SUITE_P(Scenes, LocalNetwork, testing::ValuesIn(kinds_of_networks),
                         [](const auto& scene) { return scene.param.name; });
