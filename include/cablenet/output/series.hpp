#pragma once
#include <mpi.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

/// A series writes the frames of a run as HDF5 segments that survive a crash.  ParaView opens them through cables.xmf
/// and bodies.xmf.
/// The files are mesh.h5, frames_NNNN.h5, result.h5 (which holds links), and each .xmf if it has something to show.
/// Tests: tests/parallel/series_test.cpp
namespace cablenet::output {

/// The part of the result that does not change in time.  Nodes and elements are in the scene's order, and each rank
/// holds one contiguous block of both.
struct Mesh {
  std::int64_t nodes = 0;   ///< on all ranks together
  std::int64_t elements = 0;
  std::int64_t first_node = 0;   ///< of this rank's block
  std::int64_t first_element = 0;
  std::int64_t local_nodes = 0;
  std::vector<std::array<int, 2>> lines;   ///< per element of the block: its two nodes, numbered as in the scene
  std::vector<int> cable_id;               ///< per element of the block: index into cable_names
  std::vector<int> rank;                   ///< per element of the block: the rank that computes it
  std::vector<std::string> cable_names;    ///< the cables, then the nets; the same on every rank
  std::vector<std::string> body_names;     ///< the same on every rank
  /// On rank 0: the edges of the bodies' boxes [m], (bodies, 3), and their attitudes, quaternions w x y z from the
  /// box's axes to body axes, (bodies, 4).  body_box.hpp computes both.
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
  /// On rank 0, row-major: positions [m] and velocities [m/s] of the centres of gravity, (bodies, 3) each; unit
  /// quaternions w x y z, body axes to world, (bodies, 4); angular velocities in body axes [rad/s], (bodies, 3).
  std::span<const double> body_position = {}, body_velocity = {}, body_quaternion = {}, body_angular_velocity = {};
};

/// Writes frames.  Every member function is collective over the communicator.  The destructor is not collective, and
/// loses the open segment.  A run that is killed loses the open segment and nothing else: a segment gets its final name
/// when it is closed, and result.h5 and the .xmf are then rewritten to list it.  A segment is closed as soon as
/// - it has `frames_per_segment` frames, or a tenth of the frames in closed segments if that is more.  All rewriting in
///   a long run thus costs some ten times as much as the last one.
/// - the next frame would come later than `seconds_per_segment` after the segment's start, or later than 50 times what
///   the last rewriting took if that is more.  Rewriting thus takes at most 2 % of the wall time.
/// After an OutputError for another reason than a bad directory, end the program by MPI_Abort: in MPI_Finalize HDF5
/// hangs or crashes over a file that it could not write.
class Series {
public:
  struct Options {
    int frames_per_segment = 25;
    double seconds_per_segment = 10;
    std::string scene_hash;   ///< stored as an attribute of every file
    std::string version;
  };

  /// Removes what an earlier run left in `directory`, but only files that this class writes.  Then writes the mesh.
  /// @throws OutputError on every rank alike if the directory or the mesh cannot be written
  Series(MPI_Comm communicator, std::filesystem::path directory, const Mesh& mesh, Options options);
  ~Series();
  Series(const Series&) = delete;
  Series& operator=(const Series&) = delete;

  /// @throws OutputError if the frame cannot be written, possibly on one rank alone
  void write(const Frame& frame);
  /// Closes the open segment.  Call it once at the end, after a failed run too.
  void close();

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}   // namespace cablenet::output
