#include "cablenet/output/series.hpp"

#include <cmath>
#include <regex>

#include "../support/series_files.hpp"
#include "cablenet/base/errors.hpp"

namespace fs = std::filesystem;
using namespace cablenet::output;
using namespace cablenet::test;

namespace {

constexpr int total_nodes = 17;
constexpr int total_elements = 16;

/// The first of this rank's rows and their number.  Rank `empty` has none; every other rank has 3/4 of the rows that
/// are left, and the last one the rest.
std::pair<int, int> share(int total, int empty) {
  const int size = size_of_world();
  std::vector<int> count(static_cast<std::size_t>(size), 0);
  int left = total;
  for (int r = 0; r < size; ++r)
    if (r != empty || size == 1) left -= count[static_cast<std::size_t>(r)] = 3 * left / 4;
  const int last = size == 1 ? 0 : (empty == size - 1 ? size - 2 : size - 1);
  count[static_cast<std::size_t>(last)] += left;
  int first = 0;
  for (int r = 0; r < rank_of_world(); ++r) first += count[static_cast<std::size_t>(r)];
  return {first, count[static_cast<std::size_t>(rank_of_world())]};
}

double value_of(int field, int frame, int index) { return std::sin(field + 0.1 * frame + 1.7 * index) * 1e3; }

Mesh make_mesh(int empty) {
  Mesh mesh;
  const auto [node, nodes] = share(total_nodes, empty);
  const auto [element, elements] = share(total_elements, empty);
  mesh.nodes = total_nodes;
  mesh.elements = total_elements;
  mesh.first_node = node;
  mesh.local_nodes = nodes;
  mesh.first_element = element;
  for (int e = element; e < element + elements; ++e) {
    mesh.lines.push_back({e, e + 1});
    mesh.cable_id.push_back(e % 2);
    mesh.rank.push_back(7 * e);
  }
  mesh.cable_names = {"trunk", "a longer name"};
  return mesh;
}

/// The fields of one frame on this rank, in the order of Frame.
struct Fields {
  Fields(const Mesh& mesh, int frame) {
    const auto fill = [&](int field, std::int64_t first, std::int64_t rows, int columns) {
      for (auto i = first * columns; i < (first + rows) * columns; ++i)
        values[static_cast<std::size_t>(field)].push_back(value_of(field, frame, static_cast<int>(i)));
    };
    const auto elements = static_cast<std::int64_t>(mesh.lines.size());
    fill(0, mesh.first_node, mesh.local_nodes, 3);
    fill(1, mesh.first_node, mesh.local_nodes, 3);
    fill(2, mesh.first_node, mesh.local_nodes, 1);
    fill(3, mesh.first_element, elements, 1);
    fill(4, mesh.first_element, elements, 1);
  }
  std::array<std::vector<double>, 5> values;
};

double time_of(int frame) { return frame / 3.0; }

void write_frame(Series& series, const Mesh& mesh, int frame) {
  const Fields f(mesh, frame);
  series.write({time_of(frame), 10 * frame, f.values[0], f.values[1], f.values[2], f.values[3], f.values[4]});
}

Series::Options frames_alone(int frames_per_segment) { return {frames_per_segment, 1e9, "hash", "1.2.3"}; }

void expect_mesh(hid_t file) {
  const auto lines = read<int>(file, "/mesh/lines", H5T_NATIVE_INT);
  const auto cable_id = read<int>(file, "/mesh/cable_id", H5T_NATIVE_INT);
  const auto rank = read<int>(file, "/mesh/rank", H5T_NATIVE_INT);
  ASSERT_EQ(lines.size(), 2u * total_elements);
  ASSERT_EQ(cable_id.size(), std::size_t{total_elements});
  ASSERT_EQ(rank.size(), std::size_t{total_elements});
  for (int e = 0; e < total_elements; ++e) {
    const auto i = static_cast<std::size_t>(e);
    EXPECT_EQ(lines[2 * i], e);
    EXPECT_EQ(lines[2 * i + 1], e + 1);
    EXPECT_EQ(cable_id[i], e % 2);
    EXPECT_EQ(rank[i], 7 * e);
  }
}

void expect_frame(hid_t file, int frame) {
  char group[32];
  std::snprintf(group, sizeof group, "/frames/%08d", frame);
  EXPECT_EQ(read_attribute<double>(file, group, "time", H5T_NATIVE_DOUBLE), time_of(frame));
  EXPECT_EQ(read_attribute<std::int64_t>(file, group, "step", H5T_NATIVE_INT64), 10 * frame);
  const std::array names{"points", "velocity", "tension_node", "tension", "strain"};
  const std::array units{"m", "m/s", "N", "N", "1"};
  const std::array sizes{3 * total_nodes, 3 * total_nodes, total_nodes, total_elements, total_elements};
  for (std::size_t field = 0; field < names.size(); ++field) {
    const std::string name = std::string(group) + "/" + names[field];
    const auto values = read<double>(file, name, H5T_NATIVE_DOUBLE);
    ASSERT_EQ(values.size(), static_cast<std::size_t>(sizes[field])) << name;
    EXPECT_EQ(read_text(file, name, "units"), units[field]);
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_EQ(values[i], value_of(static_cast<int>(field), frame, static_cast<int>(i))) << name << " " << i;
  }
}

/// The FILE:GROUP of the points of every step, in order.
std::vector<std::string> listed_frames(const fs::path& folder) {
  const std::string text = text_of(folder / "cables.xmf");
  const std::regex pattern(">([^>]*)/points<");
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
    found.push_back((*match)[1]);
  return found;
}

}   // namespace

TEST_F(SeriesTest, FramesComeBackExactlyThroughTheMaster) {
  for (int empty = 0; empty < size_of_world(); ++empty) {
    const Mesh mesh = make_mesh(empty);
    Series series(MPI_COMM_WORLD, folder_, mesh, frames_alone(3));
    for (int frame = 0; frame < 7; ++frame) write_frame(series, mesh, frame);
    series.close();
    if (rank_of_world() != 0) continue;
    const hid_t file = H5Fopen((folder_ / "result.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    EXPECT_GE(file, 0);
    EXPECT_EQ(read_text(file, "/", "format"), "cablenet");
    EXPECT_EQ(read_text(file, "/", "scene_hash"), "hash");
    EXPECT_EQ(read_text(file, "/", "version"), "1.2.3");
    EXPECT_EQ(read_attribute<int>(file, "/", "format_version", H5T_NATIVE_INT), 1);
    expect_mesh(file);
    for (int frame = 0; frame < 7; ++frame) expect_frame(file, frame);
    H5Fclose(file);
  }
}

TEST_F(SeriesTest, TheIndexListsExactlyTheClosedFrames) {
  const Mesh mesh = make_mesh(-1);
  Series series(MPI_COMM_WORLD, folder_, mesh, frames_alone(2));
  for (int frame = 0; frame < 3; ++frame) write_frame(series, mesh, frame);
  std::vector<std::string> expected{"frames_0000.h5:/frames/00000000", "frames_0000.h5:/frames/00000001"};
  if (rank_of_world() == 0) {
    EXPECT_EQ(listed_frames(folder_), expected);
    EXPECT_TRUE(fs::exists(folder_ / "frames_0001.h5.part"));
  }
  series.close();
  series.close();
  expected.push_back("frames_0001.h5:/frames/00000002");
  if (rank_of_world() == 0) {
    const std::set<std::string> all{"cables.xmf", "frames_0000.h5", "frames_0001.h5", "mesh.h5", "result.h5"};
    EXPECT_EQ(listed_frames(folder_), expected);
    EXPECT_EQ(files_in(folder_), all);
    EXPECT_NE(text_of(folder_ / "cables.xmf").find("<Time Value=\"0.33333333333333331\"/>"), std::string::npos);
  }
}

TEST_F(SeriesTest, ASegmentClosesWhenItIsOld) {
  const Mesh mesh = make_mesh(0);
  Series::Options options = frames_alone(1000);
  options.seconds_per_segment = 0;
  Series series(MPI_COMM_WORLD, folder_, mesh, options);
  write_frame(series, mesh, 0);
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_TRUE(fs::exists(folder_ / "frames_0000.h5"));
}

TEST_F(SeriesTest, AnEarlierRunIsRemovedAndNothingElse) {
  if (rank_of_world() == 0)
    for (const char* name :
         {"frames_0007.h5", "frames_12345.h5.part", "cables.xmf", "cables.xmf.tmp", "bodies.xmf", "bodies.xmf.tmp",
          "result.h5", "result.h5.tmp", "mesh.h5", "frames_best.h5", "frames_0007.h5.png", "history.csv"})
      std::ofstream(folder_ / name) << "old";
  MPI_Barrier(MPI_COMM_WORLD);
  const Series series(MPI_COMM_WORLD, folder_, make_mesh(0), frames_alone(3));
  const std::set<std::string> left{"mesh.h5", "frames_best.h5", "frames_0007.h5.png", "history.csv"};
  EXPECT_EQ(files_in(folder_), left);
}

TEST_F(SeriesTest, AnUnclosedSeriesIsAbandonedWithoutWaiting) {
  const Mesh mesh = make_mesh(-1);
  auto series = std::make_unique<Series>(MPI_COMM_WORLD, folder_, mesh, frames_alone(2));
  write_frame(*series, mesh, 0);
  if (rank_of_world() == 0) series.reset();
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_FALSE(fs::exists(folder_ / "frames_0000.h5"));
}

TEST_F(SeriesTest, AMeshWithoutElementsHasFramesButNothingToSee) {
  Mesh mesh;
  Series series(MPI_COMM_WORLD, folder_, mesh, frames_alone(1));
  series.write({0.5, 1, {}, {}, {}, {}, {}});
  series.close();
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_TRUE(fs::exists(folder_ / "frames_0000.h5"));
  EXPECT_FALSE(fs::exists(folder_ / "cables.xmf"));
}

TEST_F(SeriesTest, AnUnwritableDirectoryFailsOnEveryRank) {
  if (rank_of_world() == 0) std::ofstream(folder_ / "file") << "in the way";
  MPI_Barrier(MPI_COMM_WORLD);
  const fs::path directory = folder_ / "file" / "run";
  try {
    const Series series(MPI_COMM_WORLD, directory, make_mesh(0), frames_alone(3));
    ADD_FAILURE() << "no error";
  } catch (const cablenet::OutputError& error) {
    EXPECT_EQ(std::string(error.what()), "cannot create directory " + directory.string() + ": Not a directory");
  }
}

TEST_F(SeriesTest, AnObstacleInTheWayOfTheMeshFailsOnEveryRank) {
  if (rank_of_world() == 0) fs::create_directories(folder_ / "mesh.h5.part" / "inner");
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_THROW(Series(MPI_COMM_WORLD, folder_, make_mesh(0), frames_alone(3)), cablenet::OutputError);
}
