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

double drawn_length(const std::vector<Vector3>& points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

/// An inextensible cable of length L between two ends.
struct Hung {
  const char* name;
  Vector3 a, b;
  double L;
  friend void PrintTo(const Hung& item, std::ostream* out) { *out << item.name; }
};

class Catenary : public testing::TestWithParam<Hung> {};

}   // namespace

/// With many elements the curve is nearly straight between two nodes, so chords are nearly as long as arcs.
TEST_P(Catenary, NodesLieEvenlyOnACurveOfTheLengthBetweenTheEnds) {
  const auto& [name, a, b, L] = GetParam();
  constexpr int elements = 4000;
  const std::vector<Vector3> points = catenary_shape(a, b, even(L, elements));
  ASSERT_EQ(points.size(), elements + 1u);
  EXPECT_LE((points.front() - a).norm(), 1e-8 * L);
  EXPECT_LE((points.back() - b).norm(), 1e-8 * L);
  EXPECT_NEAR(drawn_length(points), L, 1e-3 * L);
  int uneven = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double ratio = (points[i] - points[i - 1]).norm() / L * elements;
    if (!(ratio > 1 - 1e-2 && ratio < 1 + 1e-4)) ++uneven;
  }
  // Only at a sharp turn may a chord be much shorter than its arc.
  EXPECT_LE(uneven, 3) << name;
}

TEST_P(Catenary, CoarseNodesAreTheFineOnes) {
  const auto& [name, a, b, L] = GetParam();
  const std::vector<Vector3> coarse = catenary_shape(a, b, even(L, 8));
  const std::vector<Vector3> fine = catenary_shape(a, b, even(L, 8 * 64));
  for (std::size_t i = 0; i < coarse.size(); ++i) EXPECT_LE((coarse[i] - fine[64 * i]).norm(), 1e-9 * L) << name;
}

/// Along a catenary T cos(angle) is constant and T sin(angle) grows linearly with arc length.  So the slope of the
/// tangent, tan(angle), is linear in arc length.
TEST_P(Catenary, HangsInEquilibrium) {
  const auto& [name, a, b, L] = GetParam();
  const double h = std::hypot(b.x() - a.x(), b.y() - a.y());
  if (h < 0.05 * L || L < (b - a).norm() * (1 + 1e-4)) return;
  const std::vector<Vector3> points = catenary_shape(a, b, even(L, 20000));
  const auto slope = [&](std::size_t i) {
    const Vector3 d = points[i + 1] - points[i];
    return d.z() / std::hypot(d.x(), d.y());
  };
  const double growth = slope(15000) - slope(5000);
  EXPECT_GT(growth, 0);
  EXPECT_NEAR(slope(10000) - slope(5000), 0.5 * growth, 1e-5 * growth) << name;
  EXPECT_NEAR(slope(19999) - slope(0), 1.9999 * growth, 1e-5 * growth) << name;
}

INSTANTIATE_TEST_SUITE_P(
    Ends, Catenary,
    testing::Values(Hung{"level", {0, 0, 0}, {10, 0, 0}, 12}, Hung{"askew", {1, 2, 3}, {7, -4, 8}, 15},
                    Hung{"downward", {0, 0, 0}, {3, 4, -10}, 14}, Hung{"deep", {0, 0, 0}, {10, 0, 0}, 90},
                    Hung{"steep", {0, 0, 0}, {1.1, 0, 30}, 100}, Hung{"steep_taut", {0, 0, 0}, {1, 0.5, -99}, 99.1},
                    Hung{"hairpin", {0, 0, 0}, {0, 0, -3}, 11}, Hung{"hairpin_up", {1, 1, 1}, {1, 1, 4}, 11},
                    Hung{"hairpin_askew", {0, 0, 0}, {0.05, 0.02, 2}, 11}, Hung{"loop", {2, 0, 1}, {2, 0, 1}, 8},
                    Hung{"nearly_taut", {0, 0, 0}, {10, 0, 2}, std::sqrt(104.0) * (1 + 1e-6)},
                    Hung{"very_nearly_taut", {0, 0, 0}, {10, 3, 2}, std::sqrt(113.0) * (1 + 1e-10)},
                    Hung{"all_but_taut", {0, 0, 0}, {10, 3, 2}, std::sqrt(113.0) * (1 + 3e-12)},
                    Hung{"taut", {0, 0, 0}, {10, 3, 2}, std::sqrt(113.0)}),
    [](const auto& item) { return item.param.name; });

/// Whatever the number of elements, neighbouring nodes must not coincide.
TEST(CatenaryShape, AHairpinsNodesLieApart) {
  for (const double height : {0.0, 1.0, -2.5, 4.9})
    for (int elements = 2; elements < 12; ++elements) {
      const std::vector<Vector3> points = catenary_shape({0, 0, 0}, {0, 0, height}, even(5, elements));
      for (std::size_t i = 1; i < points.size(); ++i)
        EXPECT_GT((points[i] - points[i - 1]).norm(), 1e-6)
            << elements << " elements, height " << height << ", element " << i;
    }
}

TEST(CatenaryShape, TooShortACableIsStraight) {
  const std::vector<Vector3> points = catenary_shape({0, 0, 0}, {3, 0, 4}, even(4, 5));
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_LE((points[i] - Vector3(3, 0, 4) * (0.2 * static_cast<double>(i))).norm(), 1e-12);
}

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
