#include "cablenet/base/index.hpp"

#include <gtest/gtest.h>

#include <type_traits>
#include <unordered_set>

using namespace cablenet;

namespace {

template <class From, class To>
constexpr bool converts = std::is_convertible_v<From, To> || std::is_constructible_v<To, From>;

static_assert(!converts<SceneNode, LocalNode> && !converts<LocalNode, SceneNode>);
static_assert(!converts<LocalNode, SolverNumber> && !converts<SolverNumber, Unknown>);
static_assert(!std::is_convertible_v<int, SceneNode>, "a number becomes an index where that is said, and nowhere else");
static_assert(!converts<SceneNode, int>);
static_assert(sizeof(LocalNode) == sizeof(int) && std::is_trivially_copyable_v<LocalNode>, "inner loops hold them");

template <class Key>
concept KeysATable = requires(Table<SceneNode, double> table, Key key) {
  table[key];
};
static_assert(KeysATable<SceneNode>);
static_assert(!KeysATable<LocalNode> && !KeysATable<int> && !KeysATable<std::size_t>);

}   // namespace

TEST(Index, IsNoneUntilItIsGiven) {
  EXPECT_FALSE(SceneNode().exists());
  EXPECT_TRUE(SceneNode(0).exists());
  EXPECT_LT(SceneNode(), SceneNode(0));
}

TEST(Index, CountsAsItsNumberDoes) {
  SolverNumber number(4);
  EXPECT_EQ((++number).value(), 5);
  EXPECT_EQ(number, SolverNumber(5));
  EXPECT_EQ((number + 2).value(), 7);
  EXPECT_EQ(number + 2 - number, 2);
  EXPECT_EQ(at(number), 5u);
  EXPECT_EQ(at(7), 7u);
  EXPECT_TRUE(std::unordered_set<SolverNumber>({SolverNumber(5)}).contains(number));
}

TEST(Table, HasAValueForEachIndexUpToItsSize) {
  Table<LocalNode, double> table(2, 0.5);
  EXPECT_EQ(table.push_back(7), LocalNode(2));
  table[LocalNode(0)] = 3;
  EXPECT_EQ(table.size(), 3);
  EXPECT_EQ(table[LocalNode(0)], 3);
  EXPECT_EQ(table[LocalNode(1)], 0.5);
  EXPECT_EQ(table.data()[2], 7);
  table.resize(5, 9);
  EXPECT_EQ(table[LocalNode(4)], 9);
  EXPECT_TRUE((Table<LocalNode, double>().empty()));
}

TEST(Table, OfFlagsCanBeWritten) {
  Table<SceneNode, bool> table(2, false);
  table[SceneNode(1)] = true;
  EXPECT_FALSE(table[SceneNode(0)]);
  EXPECT_TRUE(table[SceneNode(1)]);
}
