#include "cablenet/partition/partition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "../support/graphs.hpp"
#include "../support/networks.hpp"
#include "../support/scenes.hpp"

using namespace cablenet;
using namespace cablenet::test;

namespace {

class Partition : public testing::TestWithParam<NamedScene> {
protected:
  network::Network network_ = network_of(GetParam().text);
  partition::Partition partition_ = partition::make_partition(network_, PETSC_COMM_WORLD);
  int ranks_ = size_of(PETSC_COMM_WORLD);
  Table<SceneNode, bool> held_ = held_nodes(network_);

  /// The elements between free nodes, as pairs of solver numbers.
  Edges edges() const {
    Edges edges;
    for (const auto& element : network_.elements)
      if (!held_[element.node[0]] && !held_[element.node[1]])
        edges.emplace_back(partition_.solver_number[element.node[0]].value(),
                           partition_.solver_number[element.node[1]].value());
    return edges;
  }

  /// Per solver number: does it belong to the interface?
  std::vector<bool> on_interface() const {
    std::vector<bool> found(at(partition_.first_number.back()), false);
    for (const SolverNumber number : partition_.interface.number) found.at(at(number)) = true;
    return found;
  }

  int rank_of_number(int number) const {
    const auto next =
        std::upper_bound(partition_.first_number.begin(), partition_.first_number.end(), SolverNumber(number));
    return static_cast<int>(next - partition_.first_number.begin()) - 1;
  }
};

int value_of(int number) { return number; }
int value_of(SolverNumber number) { return number.value(); }

template <class Numbers>
void expect_same_everywhere(const Numbers& numbers) {
  std::vector<int> values;
  for (const auto& number : numbers) values.push_back(value_of(number));
  const std::vector<int> own = values;
  long count = static_cast<long>(values.size());
  MPI_Bcast(&count, 1, MPI_LONG, 0, PETSC_COMM_WORLD);
  values.resize(static_cast<std::size_t>(count));
  MPI_Bcast(values.data(), static_cast<int>(count), MPI_INT, 0, PETSC_COMM_WORLD);
  EXPECT_EQ(own, values);
}

}   // namespace

TEST_P(Partition, EveryFreeNodeHasOneOwnerAndANumberInItsRange) {
  const int free_nodes = network_.position.size() - static_cast<int>(network_.prescribed.size());
  ASSERT_EQ(partition_.node_owner.size(), network_.position.size());
  ASSERT_EQ(partition_.solver_number.size(), network_.position.size());
  ASSERT_EQ(partition_.first_number.size(), at(ranks_) + 1);
  EXPECT_EQ(partition_.first_number.front(), SolverNumber(0));
  EXPECT_EQ(partition_.first_number.back(), SolverNumber(free_nodes));
  EXPECT_TRUE(std::is_sorted(partition_.first_number.begin(), partition_.first_number.end()));
  std::set<SolverNumber> numbers;
  for (SceneNode node(0); node.value() < held_.size(); ++node) {
    const int owner = partition_.node_owner[node], i = node.value();
    const SolverNumber number = partition_.solver_number[node];
    EXPECT_TRUE(owner >= 0 && owner < ranks_) << "node " << i;
    EXPECT_EQ(held_[node], !number.exists()) << "node " << i;
    if (held_[node]) continue;
    numbers.insert(number);
    EXPECT_GE(number, partition_.first_number[at(owner)]) << "node " << i;
    EXPECT_LT(number, partition_.first_number[at(owner) + 1]) << "node " << i;
  }
  EXPECT_EQ(static_cast<int>(numbers.size()), free_nodes);
}

TEST_P(Partition, IsTheSameOnAllRanks) {
  expect_same_everywhere(partition_.node_owner);
  expect_same_everywhere(partition_.element_owner);
  expect_same_everywhere(partition_.solver_number);
  expect_same_everywhere(partition_.first_number);
  expect_same_everywhere(partition_.interface.number);
  expect_same_everywhere(partition_.interface.graph.first);
  expect_same_everywhere(partition_.interface.graph.adjacent);
}

TEST_P(Partition, NoElementJoinsInteriorsOfTwoRanks) {
  const std::vector<bool> interface = on_interface();
  for (const auto& [a, b] : edges())
    EXPECT_TRUE(interface[at(a)] || interface[at(b)] || rank_of_number(a) == rank_of_number(b)) << a << " " << b;
}

TEST_P(Partition, OneRankHasNoInterfaceAndSeveralHaveOneWhereElementsLeadAcross) {
  bool across = false;
  for (const auto& [a, b] : edges()) across = across || rank_of_number(a) != rank_of_number(b);
  EXPECT_EQ(partition_.interface.number.empty(), !across);
  EXPECT_EQ(partition_.interface.graph.vertices(), static_cast<int>(partition_.interface.number.size()));
}

TEST_P(Partition, InterfaceNodesAreTheLastOfTheirRankInTheirOrderOfElimination) {
  const std::vector<bool> interface = on_interface();
  for (int number = 0; number + 1 < partition_.first_number.back().value(); ++number) {
    const bool same_rank = rank_of_number(number) == rank_of_number(number + 1);
    EXPECT_TRUE(!interface[at(number)] || interface[at(number + 1)] || !same_rank) << number;
  }
  std::vector<int> last(at(ranks_), -1);
  for (const SolverNumber found : partition_.interface.number) {
    const int number = found.value();
    EXPECT_GT(number, last[at(rank_of_number(number))]);
    last[at(rank_of_number(number))] = number;
  }
}

TEST_P(Partition, InterfaceGraphIsWhatEliminatedInteriorsLeave) {
  const std::vector<bool> interface = on_interface();
  std::vector<int> interior;
  for (std::size_t number = 0; number < interface.size(); ++number)
    if (!interface[number]) interior.push_back(static_cast<int>(number));
  const std::vector<std::set<int>> left = eliminate(static_cast<int>(interface.size()), edges(), interior).left;
  const partition::Interface& found = partition_.interface;
  for (std::size_t i = 0; i < found.number.size(); ++i) {
    std::multiset<int> numbers;
    for (int k = found.graph.first[i]; k < found.graph.first[i + 1]; ++k)
      numbers.insert(found.number[at(found.graph.adjacent[at(k)])].value());
    const std::set<int>& expected = left[at(found.number[i])];
    EXPECT_EQ(numbers, std::multiset<int>(expected.begin(), expected.end())) << "interface node " << i;
  }
}

TEST_P(Partition, AnElementBelongsToTheOwnerOfAFreeNode) {
  ASSERT_EQ(partition_.element_owner.size(), network_.elements.size());
  for (std::size_t e = 0; e < network_.elements.size(); ++e) {
    std::set<int> allowed;
    for (const SceneNode node : network_.elements[e].node)
      if (!held_[node]) allowed.insert(partition_.node_owner[node]);
    // An element that is held at both ends may belong to any rank with rows in the solver's vectors: these can show a
    // failure of the element.
    const int owner = partition_.element_owner[e];
    if (allowed.empty() && partition_.first_number[at(owner)] < partition_.first_number[at(owner) + 1])
      allowed.insert(owner);
    EXPECT_TRUE(allowed.contains(owner)) << "element " << e;
  }
}

TEST_P(Partition, NoRankIsLeftOutOfALargeNetwork) {
  if (network_.position.size() < 16) return;
  for (int r = 0; r < ranks_; ++r)
    EXPECT_GT(partition_.first_number[at(r) + 1], partition_.first_number[at(r)]) << "rank " << r;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Partition, testing::ValuesIn(kinds_of_networks),
                         [](const auto& scene) { return scene.param.name; });

/// Three ranks cut both nets.  The strip's few interface nodes are eliminated first, though the scene has them last.
const std::string two_nets = R"(
nets:
  panel: {type: rope, corners: [[0, 0, 0], [14, 0, 0], [14, 0, -8], [0, 0, -8]], meshes: [14, 8]}
  strip: {type: rope, corners: [[0, 9, 0], [44, 9, 0], [44, 9, -2], [0, 9, -2]], meshes: [44, 2]}
)";

INSTANTIATE_TEST_SUITE_P(TwoNets, Partition, testing::Values(NamedScene{"two_nets", two_nets}));

/// The numbers run along the chain from both its ends in turns.
TEST(PartitionNumbers, RunAlongAChain) {
  const network::Network network = network_of(chain);
  const partition::Partition partition = partition::make_partition(network, PETSC_COMM_WORLD);
  const std::set<SolverNumber> interface(partition.interface.number.begin(), partition.interface.number.end());
  int steps = 0;
  for (const auto& element : network.elements) {
    const SolverNumber a = partition.solver_number[element.node[0]], b = partition.solver_number[element.node[1]];
    if (!a.exists() || !b.exists() || interface.contains(a) || interface.contains(b)) continue;
    EXPECT_LE(std::abs(a - b), 2);
    ++steps;
  }
  EXPECT_GT(steps, 10);
}
