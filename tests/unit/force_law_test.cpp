#include "cablenet/scene/force_law.hpp"

#include <gtest/gtest.h>

#include "cablenet/scene/read.hpp"

namespace cablenet::scene {
namespace {

TEST(ForceLaw, ChangesEvenlyBetweenRowsAndStaysBeyondThem) {
  const ForceLaw force = ForceLaw::rows({1, 3, 4}, {{0, 0, 2}, {4, -2, 2}, {4, -2, 0}});
  EXPECT_EQ(force.at(0), Vector3(0, 0, 2));
  EXPECT_EQ(force.at(1), Vector3(0, 0, 2));
  EXPECT_EQ(force.at(1.5), Vector3(1, -0.5, 2));
  EXPECT_EQ(force.at(3.5), Vector3(4, -2, 1));
  EXPECT_EQ(force.at(4), Vector3(4, -2, 0));
  EXPECT_EQ(force.at(9), Vector3(4, -2, 0));
  EXPECT_DOUBLE_EQ(force.largest(), std::sqrt(24.0));
}

Point read_point(const std::string& force, const std::string& time = "time: {end: 4, step: 0.1}\n") {
  return read_scene(
             "cable_types: {rope: {mass_per_length: 1, axial_stiffness: 1000}}\n"
             "points: {a: {position: [0, 0, 0], motion: fixed}, b: {position: [1, 0, 0], force: " +
                 force + "}}\ncables: {c: {type: rope, from: a, to: b, elements: 1}}\n" + time,
             "test.yaml")
      .points[1];
}

TEST(ForceLaw, ComesFromTheScene) {
  const Point constant = read_point("[1, 2, 3]");
  EXPECT_EQ(constant.force, Vector3(1, 2, 3));
  EXPECT_FALSE(constant.force_law);
  const Point rows = read_point("{waypoints: [[0, 0, 0, 0], [2, 8, 0, -4], [5, 8, 0, -4]]}");
  EXPECT_EQ(rows.force, Vector3(0, 0, 0));
  ASSERT_TRUE(rows.force_law);
  EXPECT_EQ(rows.force_law->at(0.5), Vector3(2, 0, -1));
  EXPECT_EQ(rows.force_law->at(3), Vector3(8, 0, -4)) << "a spline would swing beyond the rows";
  const Point written = read_point("{expression: {x: \"3*sin(t)\", z: \"-t^2\"}}");
  ASSERT_TRUE(written.force_law);
  EXPECT_NEAR((written.force_law->at(1.5) - Vector3(3 * std::sin(1.5), 0, -2.25)).norm(), 0, 1e-15);
  EXPECT_NEAR(written.force_law->largest(), std::hypot(3 * std::sin(4.0), 16.0), 1e-12);
}

}   // namespace
}   // namespace cablenet::scene
