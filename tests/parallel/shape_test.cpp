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

TEST(NodeArcs, ADensityGradesThem) {
  const std::vector<double> density{1, 1, 3, 3};
  const std::vector<double> arcs = node_arcs(8, 16, {}, density);
  ASSERT_EQ(arcs.size(), 17u);
  for (std::size_t i = 0; i <= 4; ++i) EXPECT_NEAR(arcs[i], static_cast<double>(i), 1e-12);
  for (std::size_t i = 4; i <= 16; ++i) EXPECT_NEAR(arcs[i], 4 + static_cast<double>(i - 4) / 3, 1e-12);
  // Taps keep their nodes, and a density that is everywhere alike is none.
  const std::vector<double> taps{2.5, 7.9};
  const std::vector<double> tapped = node_arcs(8, 16, taps, density);
  ASSERT_EQ(tapped.size(), 17u);
  for (const double tap : taps) EXPECT_EQ(tapped[static_cast<std::size_t>(node_at(tapped, tap))], tap);
  for (std::size_t i = 1; i < tapped.size(); ++i) EXPECT_GT(tapped[i], tapped[i - 1]);
  const std::vector<double> alike = node_arcs(8, 16, taps, {2, 2, 2}), even_ones = node_arcs(8, 16, taps);
  for (std::size_t i = 0; i < alike.size(); ++i) EXPECT_NEAR(alike[i], even_ones[i], 1e-12);
  EXPECT_THROW(node_arcs(8, 2, taps, density), InputError);
}

TEST(RemeshedShape, KeepsTheStretchThatWasDrawn) {
  // A chain of 40 links on a parabola, stretched by 0.1 % at one end and not at the other.
  const int links = 40;
  const double link = 1;
  std::vector<Vector3> line{{0, 0, 0}};
  for (int i = 0; i < links; ++i) {
    const double slope = 2.0 * i / links - 1;
    line.push_back(line.back() + link * (1 + 1e-3 * i / links) * Vector3(1, 0, slope).normalized());
  }
  for (const int elements : {7, 13, 40, 160}) {
    const std::vector<double> arcs = even(links * link, elements);
    const std::vector<Vector3> points = remeshed_shape(line, arcs);
    EXPECT_LE((points.front() - line.front()).norm() + (points.back() - line.back()).norm(), 1e-12);
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double middle = (arcs[i] + arcs[i - 1]) / 2 / (links * link);
      const double stretch = (points[i] - points[i - 1]).norm() / (arcs[i] - arcs[i - 1]) - 1;
      EXPECT_NEAR(stretch, 1e-3 * middle, 3e-5) << elements << " elements, " << i;
    }
  }
}

TEST(RemeshedShape, LiesOnTheLineOfAPolylineThatIsNoMesh) {
  const std::vector<Vector3> line{{0, 0, 0}, {3, 0, 0}, {3, 4, 0}};
  const std::vector<Vector3> points = remeshed_shape(line, even(7, 2));
  EXPECT_LE((points[1] - Vector3(3, 0.5, 0)).norm(), 1e-12);
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
