#include "cablenet/network/shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cablenet/base/errors.hpp"

using namespace cablenet;
using namespace cablenet::network;

namespace {

std::vector<double> even(double L, int elements) { return node_arcs(L, elements, {}); }

}   // namespace

TEST(NodeArcs, ElementsAreSharedOutInProportion) {
  for (int elements = 5; elements < 60; ++elements) {
    std::vector<double> taps{7.3, 1.1, 1.2, 1.2 + 1e-13, 0, 10};
    const std::vector<double> arcs = node_arcs(10, elements, taps);
    ASSERT_EQ(arcs.size(), static_cast<std::size_t>(elements) + 1);
    EXPECT_EQ(arcs.front(), 0);
    EXPECT_EQ(arcs.back(), 10);
    for (const double tap : taps) {
      const auto node = static_cast<std::size_t>(node_at(arcs, tap));
      EXPECT_NEAR(arcs[node], tap, 1e-12);
    }
    for (std::size_t i = 1; i < arcs.size(); ++i) {
      EXPECT_GT(arcs[i], arcs[i - 1]);
      EXPECT_LE(arcs[i] - arcs[i - 1], elements < 8 ? 6.2 : 10.0 / elements * 2) << elements << " elements";
    }
  }
  EXPECT_THROW(node_arcs(10, 3, {7.3, 1.1, 1.2}), InputError);
  EXPECT_EQ(node_arcs(10, 4, {7.3, 1.1, 1.2}).size(), 5u);
}

TEST(NodeArcs, ManyTapsOnTheEvenGridKeepIt) {
  std::vector<double> taps;
  for (int k = 1; k < 300; k += 2) taps.push_back(0.1 * k);
  const std::vector<double> arcs = node_arcs(30, 300, taps);
  for (std::size_t i = 0; i < arcs.size(); ++i) EXPECT_NEAR(arcs[i], 0.1 * static_cast<double>(i), 1e-11);
}

TEST(PolylineShape, NodesLieEvenlyByLengthOrOnePerPoint) {
  const std::vector<Vector3> line{{0, 0, 0}, {3, 0, 0}, {3, 4, 0}, {3, 4, -5}};
  const std::vector<Vector3> even_ones = polyline_shape(line, even(24, 6));
  const std::vector<Vector3> expected{{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {3, 3, 0}, {3, 4, -1}, {3, 4, -3}, {3, 4, -5}};
  ASSERT_EQ(even_ones.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_LE((even_ones[i] - expected[i]).norm(), 1e-12);
  EXPECT_EQ(polyline_shape(line, even(24, 3)), line);
}

TEST(PolylineShape, RepeatedPointsAreHarmless) {
  const std::vector<Vector3> line{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, 0}};
  const std::vector<Vector3> points = polyline_shape(line, even(1, 4));
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_LE((points[i] - Vector3(0.5 * static_cast<double>(i), 0, 0)).norm(), 1e-12);
}

TEST(StraightShape, NodesFollowTheArcs) {
  const std::vector<Vector3> points = straight_shape({1, 1, 1}, {5, 1, 1}, {0, 1, 4, 8});
  const std::vector<Vector3> expected{{1, 1, 1}, {1.5, 1, 1}, {3, 1, 1}, {5, 1, 1}};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_LE((points[i] - expected[i]).norm(), 1e-12);
}
