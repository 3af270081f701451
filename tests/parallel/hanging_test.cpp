#include "cablenet/network/hanging.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cablenet/network/build.hpp"
#include "cablenet/network/shape.hpp"
#include "cablenet/scene/read.hpp"

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

namespace {

/// A cable with legs of heights h1 and h2 above 0, of one horizontal pull A over weight, and a length that lies.  Each
/// leg is A (cosh(x/A) - 1) high and A sinh(x/A) long from where it comes to lie.
struct Lying {
  const char* name;
  double A, h1, h2, lies;
  double run(double h) const { return A * std::acosh(1 + h / A); }
  double arc(double h) const { return A * std::sinh(run(h) / A); }
  double span() const { return run(h1) + lies + run(h2); }
  double length() const { return arc(h1) + lies + arc(h2); }
  friend void PrintTo(const Lying& item, std::ostream* out) { *out << item.name; }
};

class Touchdown : public testing::TestWithParam<Lying> {};

constexpr int fine = 2000;

}   // namespace

/// In every direction, on a bed and under a surface.
TEST_P(Touchdown, LegsAreCatenariesThatArriveFlat) {
  const Lying& line = GetParam();
  const double L = line.length();
  for (const double turn : {0.0, 0.7, 2.5, 4.0})
    for (const bool floats : {false, true}) {
      const Vector3 along(std::cos(turn), std::sin(turn), 0), up(0, 0, floats ? -1 : 1), foot(3, -7, 11);
      const Vector3 a = foot + line.h1 * up, b = foot + line.span() * along + line.h2 * up;
      const std::vector<Vector3> points = catenary_shape(a, b, even(L, fine), {floats, foot.z(), 0.3});
      for (std::size_t i = 0; i < points.size(); ++i) {
        const double s = L * static_cast<double>(i) / fine, t1 = line.arc(line.h1) - s, t2 = s - L + line.arc(line.h2);
        double x = s - line.arc(line.h1) + line.run(line.h1), z = 0;
        if (t1 > 0) x = line.run(line.h1) - line.A * std::asinh(t1 / line.A), z = std::hypot(t1, line.A) - line.A;
        if (t2 > 0)
          x = line.span() - line.run(line.h2) + line.A * std::asinh(t2 / line.A), z = std::hypot(t2, line.A) - line.A;
        EXPECT_LE((points[i] - (foot + x * along + z * up)).norm(), 1e-9 * L) << "node " << i << ", turned by " << turn;
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Lines, Touchdown,
                         testing::Values(Lying{"mooring", 120, 0, 200, 300}, Lying{"backwards", 120, 200, 0, 300},
                                         Lying{"two_legs", 50, 30, 80, 40}, Lying{"grazing", 50, 30, 80, 1e-3},
                                         Lying{"nearly_slack", 1e-2, 0, 60, 100}, Lying{"taut", 3e4, 0, 50, 10},
                                         Lying{"low", 1e3, 0, 1e-4, 100}),
                         [](const auto& item) { return item.param.name; });

/// Too long a cable hangs upright, and all the rest lies on the bed, as long as it is.
TEST(TouchdownShape, WhatNothingPullsLiesAtItsLength) {
  struct Case {
    Vector3 a, b;
    double L;
  };
  for (const auto& [a, b, L] : {Case{{-400, 0, 0}, {0, 0, 200}, 850}, Case{{-400, 0, 0}, {0, 0, 200}, 600.0001},
                                Case{{0, 3, 50}, {20, 60, 80}, 400}, Case{{0, 0, 40}, {0, 0, 40}, 200},
                                Case{{0, 0, 0}, {30, 0, 0}, 50}, Case{{5, 5, 0}, {5, 5, 0}, 9}}) {
    const std::vector<Vector3> points = catenary_shape(a, b, even(L, 4000), {.rest = 0});
    double lowest = 0;
    for (const Vector3& point : points) lowest = std::min(lowest, point.z());
    EXPECT_EQ(lowest, 0);
    EXPECT_NEAR(drawn_length(points), L, 1e-3 * L);
    EXPECT_EQ(points.front(), a);
    EXPECT_EQ(points.back(), b);
    for (int elements = 2; elements < 9; ++elements) {
      const std::vector<Vector3> coarse = catenary_shape(a, b, even(L, elements), {.rest = 0});
      for (std::size_t i = 1; i < coarse.size(); ++i)
        EXPECT_GT((coarse[i] - coarse[i - 1]).norm(), 1e-4 * L) << elements << " elements, element " << i;
    }
  }
}

TEST(TouchdownShape, WhereNothingTouchesItIsTheCatenary) {
  const Vector3 a(0, 0, 30), b(100, 0, 50);
  const std::vector<double> arcs = even(110, 20);
  const std::vector<Vector3> free = catenary_shape(a, b, arcs), low = catenary_shape(a, b, arcs, {.rest = 0});
  for (std::size_t i = 0; i < free.size(); ++i) EXPECT_LE((free[i] - low[i]).norm(), 1e-10);
}

/// An anchor inside the bed: the cable comes straight up and lies on the bed.
TEST(TouchdownShape, FromAnAnchorInTheBedItComesUp) {
  const std::vector<Vector3> points = catenary_shape({0, 0, -2}, {100, 0, 20}, even(110, 220), {.rest = 0});
  for (std::size_t i = 4; i < points.size(); ++i) EXPECT_GE(points[i].z(), -1e-12);
}

/// A floating line from a deck to a place under water: down to the surface by its weight, along it, and down.
TEST(TouchdownShape, AFloatingLineLiesOnTheSurface) {
  const double A = 60, beyond = 0.25, h = 10, d = 30, lies = 25, above = beyond * A;
  const double run1 = above * std::acosh(1 + h / above), run2 = A * std::acosh(1 + d / A);
  const double arc1 = above * std::sinh(run1 / above), arc2 = A * std::sinh(run2 / A);
  const double L = arc1 + lies + arc2;
  const std::vector<Vector3> points =
      catenary_shape({0, 0, h}, {0, run1 + lies + run2, -d}, even(L, fine), {true, 0.0, beyond});
  EXPECT_NEAR(drawn_length(points), L, 1e-5 * L);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double s = L * static_cast<double>(i) / fine;
    double z = 0;
    if (s < arc1) z = std::hypot(above, arc1 - s) - above;
    if (s > L - arc2) z = A - std::hypot(A, s - L + arc2);
    EXPECT_NEAR(points[i].z(), z, 1e-8 * L);
  }
}

namespace {

/// A cable from (0, 0, -100) to (150, 0, -100), `length` long, in water of 1000 kg/m^3 on a bed at -120.
Network drawn_in_water(double mass_per_length, const std::string& length) {
  const std::string text = R"(
environment: {fluid: {density: 1000, surface: 0}, seabed: {level: -120, stiffness: 1e5}}
cable_types: {line: {diameter: 0.1, mass_per_length: )" +
                           std::to_string(mass_per_length) + R"(, axial_stiffness: 1e8}}
points: {a: {position: [0, 0, -100], motion: fixed}, b: {position: [150, 0, -100], motion: fixed}}
cables: {c: {type: line, from: a, to: b, elements: 40, shape: catenary, length: )" +
                           length + "}}";
  return build_network(scene::read_scene(text, "test.yaml"));
}

std::pair<double, double> heights(const Network& network) {
  double low = 1e9, high = -1e9;
  for (const Vector3& p : network.position) low = std::min(low, p.z()), high = std::max(high, p.z());
  return {low, high};
}

}   // namespace

/// The water that 0.1 m displaces weighs 7.85 kg/m.
TEST(Hanging, AScenesCablesSinkToTheBedAndFloatToTheSurface) {
  const auto [lowest, top] = heights(drawn_in_water(12, "160"));
  EXPECT_NEAR(lowest, -120, 1e-9);
  EXPECT_NEAR(top, -100, 1e-9);
  const auto [bottom, highest] = heights(drawn_in_water(5, "160"));
  EXPECT_NEAR(bottom, -100, 1e-9);
  EXPECT_GT(highest, -80);
  EXPECT_LT(highest, -60);
  EXPECT_NEAR(heights(drawn_in_water(5, "500")).second, 0, 1e-9);
}
