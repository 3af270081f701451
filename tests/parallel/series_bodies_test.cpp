#include <array>
#include <regex>

#include "../support/series_files.hpp"
#include "cablenet/output/series.hpp"

namespace fs = std::filesystem;
using namespace cablenet::output;
using namespace cablenet::test;

namespace {

constexpr std::size_t total_bodies = 3;

std::vector<double> numbered(std::size_t count, double from) {
  std::vector<double> values;
  if (rank_of_world() == 0)
    for (std::size_t i = 0; i < count; ++i) values.push_back(from + 0.25 * static_cast<double>(i));
  return values;
}

void add_bodies(Mesh& mesh) {
  mesh.body_names = {"anchor", "b", "a longer name"};
  mesh.body_box = numbered(3 * total_bodies, 1);
  mesh.body_box_attitude = numbered(4 * total_bodies, -1);
}

/// A mesh of two elements, which are on the last rank, and of the bodies.
Mesh mesh_with_bodies() {
  const bool mine = rank_of_world() == size_of_world() - 1;
  Mesh mesh;
  mesh.nodes = 3;
  mesh.elements = 2;
  mesh.first_node = mine ? 0 : 3;
  mesh.first_element = mine ? 0 : 2;
  mesh.local_nodes = mine ? 3 : 0;
  if (mine) {
    mesh.lines = {{0, 1}, {1, 2}};
    mesh.cable_id = {0, 0};
    mesh.rank = {0, 0};
  }
  mesh.cable_names = {"rope"};
  add_bodies(mesh);
  return mesh;
}

struct BodyFields {
  explicit BodyFields(int frame)
      : values{numbered(3 * total_bodies, 10 * frame + 1), numbered(3 * total_bodies, 10 * frame + 2),
               numbered(4 * total_bodies, 10 * frame + 3), numbered(3 * total_bodies, 10 * frame + 4)} {}
  std::array<std::vector<double>, 4> values;
};

constexpr std::array body_fields{"body_position", "body_velocity", "body_quaternion", "body_angular_velocity"};

void write_frame(Series& series, const Mesh& mesh, int frame) {
  const auto nodes = static_cast<std::size_t>(mesh.local_nodes);
  const std::vector<double> vectors(3 * nodes, 0.5), scalars(nodes, 0.5), forces(mesh.lines.size(), 0.5);
  const auto [position, velocity, quaternion, angular_velocity] = BodyFields(frame).values;
  series.write({0.5 * frame, frame, vectors, vectors, scalars, forces, forces, position, velocity, quaternion,
                angular_velocity});
}

Series::Options frames_alone(int frames_per_segment) { return {frames_per_segment, 1e9, "hash", "1.2.3"}; }

/// The shape of a dataset, or -1, -1 if there is none of that name.
std::array<int, 2> shape_of(hid_t file, const std::string& name) {
  const hid_t dataset = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
  if (dataset < 0) return {-1, -1};
  const hid_t space = H5Dget_space(dataset);
  std::array<hsize_t, 2> size{0, 0};
  EXPECT_EQ(H5Sget_simple_extent_dims(space, size.data(), nullptr), 2) << name;
  H5Sclose(space);
  H5Dclose(dataset);
  return {static_cast<int>(size[0]), static_cast<int>(size[1])};
}

/// Every dataset FILE:DATASET that an index lists has the shape that the index states.
void expect_listed_shapes(const fs::path& folder, const char* index) {
  const std::string text = text_of(folder / index);
  const std::regex pattern("Dimensions=\"(\\d+) (\\d+)\">([^:<]*):([^<]*)<");
  int items = 0;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match, ++items) {
    const hid_t file = H5Fopen((folder / (*match)[3].str()).c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    EXPECT_GE(file, 0) << (*match)[3];
    const std::array listed{std::stoi((*match)[1]), std::stoi((*match)[2])};
    EXPECT_EQ(shape_of(file, (*match)[4]), listed) << match->str();
    H5Fclose(file);
  }
  EXPECT_GT(items, 0);
}

std::ptrdiff_t steps_in(const fs::path& index) {
  const std::string text = text_of(index);
  const std::regex pattern("<Time ");
  return std::distance(std::sregex_iterator(text.begin(), text.end(), pattern), std::sregex_iterator());
}

class SeriesBodiesTest : public SeriesTest {};

}   // namespace

TEST_F(SeriesBodiesTest, BodiesComeBackExactlyThroughTheMaster) {
  const Mesh mesh = mesh_with_bodies();
  Series series(MPI_COMM_WORLD, folder_, mesh, frames_alone(2));
  for (int frame = 0; frame < 3; ++frame) write_frame(series, mesh, frame);
  series.close();
  if (rank_of_world() != 0) return;
  const hid_t file = H5Fopen((folder_ / "result.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  EXPECT_EQ(read<double>(file, "/mesh/body_box", H5T_NATIVE_DOUBLE), mesh.body_box);
  EXPECT_EQ(read<double>(file, "/mesh/body_box_attitude", H5T_NATIVE_DOUBLE), mesh.body_box_attitude);
  EXPECT_EQ(read<int>(file, "/mesh/body_vertices", H5T_NATIVE_INT), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(read_text(file, "/mesh/body_box", "units"), "m");
  const std::array units{"m", "m/s", "1", "rad/s"};
  for (int frame = 0; frame < 3; ++frame)
    for (std::size_t field = 0; field < body_fields.size(); ++field) {
      const std::string name = "/frames/0000000" + std::to_string(frame) + "/" + body_fields[field];
      EXPECT_EQ(read<double>(file, name, H5T_NATIVE_DOUBLE), BodyFields(frame).values[field]) << name;
      EXPECT_EQ(read_text(file, name, "units"), units[field]);
    }
  H5Fclose(file);
}

TEST_F(SeriesBodiesTest, TheIndexListsTheClosedFramesWithTheirShapes) {
  const Mesh mesh = mesh_with_bodies();
  Series series(MPI_COMM_WORLD, folder_, mesh, frames_alone(2));
  for (int frame = 0; frame < 3; ++frame) write_frame(series, mesh, frame);
  if (rank_of_world() == 0) {
    EXPECT_EQ(steps_in(folder_ / "bodies.xmf"), 2);
    EXPECT_EQ(steps_in(folder_ / "cables.xmf"), 2);
  }
  series.close();
  if (rank_of_world() != 0) return;
  EXPECT_EQ(steps_in(folder_ / "bodies.xmf"), 3);
  expect_listed_shapes(folder_, "bodies.xmf");
  expect_listed_shapes(folder_, "cables.xmf");
}

TEST_F(SeriesBodiesTest, BodiesNeedNoCables) {
  Mesh mesh;
  add_bodies(mesh);
  Series series(MPI_COMM_WORLD, folder_, mesh, frames_alone(1));
  write_frame(series, mesh, 0);
  series.close();
  if (rank_of_world() != 0) return;
  EXPECT_EQ(files_in(folder_), (std::set<std::string>{"bodies.xmf", "frames_0000.h5", "mesh.h5", "result.h5"}));
  expect_listed_shapes(folder_, "bodies.xmf");
}
