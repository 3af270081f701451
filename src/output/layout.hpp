#pragma once
#include <cstdint>
#include <string>

#include "hdf5_file.hpp"

/// The files of a run refer to each other by these names.
namespace cablenet::output {

/// The program's version and the scene that a file comes from.
struct Origin {
  std::string version;
  std::string scene_hash;
};

std::string segment_name(int segment);        ///< path of a segment's file, relative to the run directory
std::string frame_name(std::int64_t frame);   ///< absolute path of a frame's group in that file

/// Writes the root attributes that every file of a run has.  Collective over the file's communicator.
void stamp(Hdf5File& file, const Origin& origin);

}   // namespace cablenet::output
