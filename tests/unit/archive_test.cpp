#include "cablenet/base/archive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

using namespace cablenet;

namespace {

struct Kept {
  double time = 0;
  long steps = 0;
  int count = 0;
  bool is_good = false;
  Vector3 position = Vector3::Zero();
  std::vector<double> history;
  std::vector<double> field = std::vector<double>(2);

  void archive(Archive& archive) {
    archive.item("time", time);
    archive.item("steps", steps);
    archive.item("count", count);
    archive.item("is_good", is_good);
    archive.item("position", position);
    archive.item("history", history);
    archive.item("field", std::span(field));
  }
};

Archive saved(Kept kept) {
  Archive archive;
  kept.archive(archive);
  return Archive(archive.entries());
}

std::string complaint(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}   // namespace

TEST(Archive, ReturnsWhatWasSavedBitForBit) {
  const long many = std::numeric_limits<long>::max();
  Archive archive = saved({0.1, many, -3, true, {1, -0.0, 1e-300}, {0.2, 0.3, 0.4}, {5, 6}});
  ASSERT_TRUE(archive.is_loading());
  Kept kept;
  kept.archive(archive);
  EXPECT_EQ(kept.time, 0.1);
  EXPECT_EQ(kept.steps, many);
  EXPECT_EQ(kept.count, -3);
  EXPECT_TRUE(kept.is_good);
  EXPECT_EQ(kept.position, Vector3(1, 0, 1e-300));
  EXPECT_TRUE(std::signbit(kept.position.y()));
  EXPECT_EQ(kept.history, (std::vector<double>{0.2, 0.3, 0.4}));
  EXPECT_EQ(kept.field, (std::vector<double>{5, 6}));
}

TEST(Archive, RefusesAnotherNameTypeOrSize) {
  double number = 0;
  long whole = 0;
  EXPECT_NE(complaint([&] { saved({}).item("speed", number); }).find("time where speed"), std::string::npos);
  EXPECT_NE(complaint([&] { saved({}).item("time", whole); }), "");
  Archive archive = saved({});
  Kept kept;
  kept.field.resize(3);
  EXPECT_NE(complaint([&] { kept.archive(archive); }).find("2 numbers of field, this run has 3"), std::string::npos);
  Archive whole_archive = saved({});
  Kept all;
  all.archive(whole_archive);
  EXPECT_NE(complaint([&] { whole_archive.item("more", number); }).find("no more"), std::string::npos);
}
