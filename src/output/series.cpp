#include "cablenet/output/series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <numeric>
#include <optional>
#include <utility>

#include "cablenet/base/errors.hpp"
#include "catalogue.hpp"
#include "files.hpp"
#include "hdf5_file.hpp"
#include "layout.hpp"

namespace cablenet::output {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point instant) {
  return std::chrono::duration<double>(Clock::now() - instant).count();
}

int rank_in(MPI_Comm communicator) {
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  return rank;
}

Rows rows_on_rank_0(std::size_t count, int rank) {
  const auto rows = static_cast<std::int64_t>(count);
  return rank == 0 ? Rows{rows, 0, rows} : Rows{rows, rows, 0};
}

/// Does `work` on every rank.  If it throws, every rank throws the text of the lowest rank that failed.  Collective.
template <class Work>
void agree(MPI_Comm communicator, const Work& work) {
  std::string error;
  try {
    work();
  } catch (const std::exception& caught) {
    error = caught.what();
  }
  int size = 0;
  MPI_Comm_size(communicator, &size);
  int speaker = error.empty() ? size : rank_in(communicator);
  MPI_Allreduce(MPI_IN_PLACE, &speaker, 1, MPI_INT, MPI_MIN, communicator);
  if (speaker == size) return;
  int length = static_cast<int>(error.size());
  MPI_Bcast(&length, 1, MPI_INT, speaker, communicator);
  error.resize(static_cast<std::size_t>(length));
  MPI_Bcast(error.data(), length, MPI_CHAR, speaker, communicator);
  throw OutputError(error);
}

}   // namespace

struct Series::Impl {
  Impl(MPI_Comm comm, fs::path run_directory, const Mesh& mesh, const Options& given)
      : communicator(comm),
        rank(rank_in(comm)),
        directory(std::move(run_directory)),
        options(given),
        nodes{mesh.nodes, mesh.first_node, mesh.local_nodes},
        elements{mesh.elements, mesh.first_element, static_cast<std::int64_t>(mesh.lines.size())},
        bodies(rows_on_rank_0(mesh.body_names.size(), rank)),
        catalogue(directory, origin(), {mesh.nodes, mesh.elements, bodies.total}) {}

  Origin origin() const { return {options.version, options.scene_hash}; }
  void write_mesh(const Mesh& mesh);
  void write_body_mesh(Hdf5File& out, const Mesh& mesh);
  void open_segment();
  void write_fields(const Frame& frame);
  bool segment_is_due();
  void close_segment();

  MPI_Comm communicator;
  int rank;
  fs::path directory;
  Options options;
  Rows nodes;
  Rows elements;
  Rows bodies;
  Catalogue catalogue;   ///< used on rank 0 alone

  std::optional<Hdf5File> file;   ///< the open segment
  int segment = 0;                ///< number of the open or next segment
  std::int64_t frames = 0;        ///< in all segments
  std::int64_t open_frames = 0;   ///< in the open segment

  Clock::time_point opened = Clock::now();
  Clock::time_point last_write = Clock::now();
  double catalogue_seconds = 0;   ///< time that the last writing of the catalogue took
};

// The ranks agree after each step.  A rank that failed would otherwise leave the others waiting in the next one.
void Series::Impl::write_mesh(const Mesh& mesh) {
  const fs::path part = directory / "mesh.h5.part";
  const Rows names = rows_on_rank_0(mesh.cable_names.size(), rank);
  const std::span<const int> lines(mesh.lines.empty() ? nullptr : mesh.lines.front().data(), 2 * mesh.lines.size());
  std::optional<Hdf5File> out;
  const auto step = [this](const auto& work) { agree(communicator, work); };
  step([&] { out.emplace(communicator, part); });
  step([&] { stamp(*out, origin()); });
  step([&] { out->create_group("/mesh"); });
  step([&] { out->write_rows("/mesh/lines", elements, 2, lines); });
  step([&] { out->write_rows("/mesh/cable_id", elements, one_dimensional, mesh.cable_id); });
  step([&] { out->write_rows("/mesh/rank", elements, one_dimensional, mesh.rank); });
  step([&] { out->write_strings("/mesh/cable_names", names, mesh.cable_names); });
  if (bodies.total > 0) write_body_mesh(*out, mesh);
  step([&] { out->close(); });
  step([&] {
    if (rank == 0) publish(part, directory / "mesh.h5");
  });
}

void Series::Impl::write_body_mesh(Hdf5File& out, const Mesh& mesh) {
  std::vector<int> vertices(static_cast<std::size_t>(bodies.local));
  std::iota(vertices.begin(), vertices.end(), 0);
  const auto step = [this](const auto& work) { agree(communicator, work); };
  step([&] { out.write_strings("/mesh/body_names", bodies, mesh.body_names); });
  step([&] { out.write_rows("/mesh/body_vertices", bodies, 1, vertices); });
  step([&] { out.write_rows("/mesh/body_box", bodies, 3, mesh.body_box); });
  step([&] { out.set_attribute("/mesh/body_box", "units", "m"); });
  step([&] { out.write_rows("/mesh/body_box_attitude", bodies, 4, mesh.body_box_attitude); });
  step([&] { out.set_attribute("/mesh/body_box_attitude", "units", "1"); });
}

void Series::Impl::open_segment() {
  opened = Clock::now();
  file.emplace(communicator, directory / (segment_name(segment) + ".part"));
  stamp(*file, origin());
  file->create_group("/frames");
}

void Series::Impl::write_fields(const Frame& frame) {
  const std::string group = frame_name(frames);
  const auto field = [&](const char* name, const Rows& rows, int columns, std::span<const double> values,
                         const char* units) {
    const std::string dataset = group + "/" + name;
    file->write_rows(dataset, rows, columns, values);
    file->set_attribute(dataset, "units", units);
  };
  file->create_group(group);
  file->set_attribute(group, "time", frame.time);
  file->set_attribute(group, "step", frame.step);
  field("points", nodes, 3, frame.points, "m");
  field("velocity", nodes, 3, frame.velocity, "m/s");
  field("tension_node", nodes, one_dimensional, frame.tension_node, "N");
  field("tension", elements, one_dimensional, frame.tension, "N");
  field("strain", elements, one_dimensional, frame.strain, "1");
  if (bodies.total == 0) return;
  field("body_position", bodies, 3, frame.body_position, "m");
  field("body_velocity", bodies, 3, frame.body_velocity, "m/s");
  field("body_quaternion", bodies, 4, frame.body_quaternion, "1");
  field("body_angular_velocity", bodies, 3, frame.body_angular_velocity, "rad/s");
}

/// Rank 0 decides for all ranks, because their clocks differ.
bool Series::Impl::segment_is_due() {
  int due = 0;
  if (rank == 0) {
    const std::int64_t frame_limit = std::max<std::int64_t>(options.frames_per_segment, (frames - open_frames) / 10);
    const double time_limit = std::max(options.seconds_per_segment, 50 * catalogue_seconds);
    // The next frame is expected to take as long as this one did.
    const double age_at_next = seconds_since(opened) + seconds_since(last_write);
    due = open_frames >= frame_limit || age_at_next >= time_limit;
    last_write = Clock::now();
  }
  MPI_Bcast(&due, 1, MPI_INT, 0, communicator);
  return due != 0;
}

void Series::Impl::close_segment() {
  file->close();
  file.reset();
  MPI_Barrier(communicator);
  if (rank == 0) {
    const auto begin = Clock::now();
    const fs::path path = directory / segment_name(segment);
    publish(path.string() + ".part", path);
    catalogue.close_segment();
    catalogue_seconds = seconds_since(begin);
  }
  ++segment;
  open_frames = 0;
}

Series::Series(MPI_Comm communicator, fs::path directory, const Mesh& mesh, Options options)
    : impl_(std::make_unique<Impl>(communicator, std::move(directory), mesh, options)) {
  agree(communicator, [this] {
    if (impl_->rank == 0) prepare_directory(impl_->directory);
  });
  impl_->write_mesh(mesh);
}

// An open segment is left as it is: closing it could wait for ranks that leave in another way.
Series::~Series() = default;

void Series::write(const Frame& frame) {
  if (!impl_->file) impl_->open_segment();
  impl_->write_fields(frame);
  if (impl_->rank == 0) impl_->catalogue.add_frame(frame.time);
  ++impl_->frames;
  ++impl_->open_frames;
  if (impl_->segment_is_due()) impl_->close_segment();
}

void Series::close() {
  if (impl_->file) impl_->close_segment();
}

}   // namespace cablenet::output
