#pragma once
#include <mpi.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

/// Frames of a run as crash-safe HDF5 segments that ParaView opens through cables.xmf and bodies.xmf.
/// Files: mesh.h5, frames_NNNN.h5, result.h5 (links), and each .xmf where it has something to show.
/// Tests: tests/parallel/series_test.cpp
namespace cablenet::output {

/// The static mesh: nodes and elements in the scene's order, each rank holding one contiguous block of both.
struct Mesh {
  std::int64_t nodes = 0;   ///< on all ranks together
  std::int64_t elements = 0;
  std::int64_t first_node = 0;   ///< of this rank's block
  std::int64_t first_element = 0;
  std::int64_t local_nodes = 0;
  std::vector<std::array<int, 2>> lines;   ///< this rank's elements: their two nodes, scene numbering
  std::vector<int> cable_id;               ///< per element of the block: index into cable_names
  std::vector<int> rank;                   ///< per element of the block: the rank that computes it
  std::vector<std::string> cable_names;    ///< cables, then nets; the same on every rank
  std::vector<std::string> body_names;     ///< the same on every rank
  /// On rank 0: edges of the uniform box that has the body's mass and inertia [m], (bodies, 3); and how the box lies in
  /// body axes, a quaternion w x y z, (bodies, 4).
  std::vector<double> body_box, body_box_attitude;
};

/// This rank's block of one instant.
struct Frame {
  double time;                            ///< [s], the same on every rank
  std::int64_t step;                      ///< the same on every rank
  std::span<const double> points;         ///< [m], (local_nodes, 3) row-major
  std::span<const double> velocity;       ///< [m/s], (local_nodes, 3) row-major
  std::span<const double> tension_node;   ///< mean tension of the elements at a node [N], (local_nodes)
  std::span<const double> tension;        ///< [N], per element of the block
  std::span<const double> strain;         ///< [1], per element of the block
  /// On rank 0, row-major: of the centres of gravity (bodies, 3) [m] and [m/s]; unit quaternions w x y z, body axes to
  /// world (bodies, 4); in body axes (bodies, 3) [rad/s].
  std::span<const double> body_position = {}, body_velocity = {}, body_quaternion = {}, body_angular_velocity = {};
};

/// Writes frames.  Every member function is collective over the communicator; the destructor is not, and loses the open
/// segment.  A run that is killed loses the open segment and nothing else: only closed ones have their final name and
/// are listed in result.h5 and the .xmf, which are rewritten each time.  A segment is closed
/// - at `frames_per_segment` frames, or at a tenth of those closed before where that is more: so all the rewriting of
///   a long run costs as much as some ten times its last one;
/// - where the next frame would come after `seconds_per_segment`, or after 50 times what the last rewriting took where
///   that is more: so it takes at most 2 % of the wall time.
/// After an OutputError but for a bad directory, end by MPI_Abort: HDF5 hangs or crashes in MPI_Finalize over a file
/// that it could not write.
class Series {
public:
  struct Options {
    int frames_per_segment = 25;
    double seconds_per_segment = 10;
    std::string scene_hash;   ///< stored as an attribute of every file
    std::string version;
  };

  /// Removes what an earlier run left in `directory` (only files this class writes) and writes the mesh.
  /// @throws OutputError on every rank alike if the directory or the mesh cannot be written.
  Series(MPI_Comm communicator, std::filesystem::path directory, const Mesh& mesh, Options options);
  ~Series();
  Series(const Series&) = delete;
  Series& operator=(const Series&) = delete;

  /// @throws OutputError if the frame cannot be written.
  void write(const Frame& frame);
  /// Closes the open segment; call once at the end, also after a failed run.
  void close();

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}   // namespace cablenet::output
