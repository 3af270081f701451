#pragma once
#include <cstdint>
#include <string>

#include "hdf5_file.hpp"

/// The names that the files of a run know each other by.
namespace cablenet::output {

struct Origin {
  std::string version;
  std::string scene_hash;
};

std::string segment_name(int segment);        ///< a file, relative to the run directory
std::string frame_name(std::int64_t frame);   ///< a group in it, absolute

/// The root attributes that every file of a run has.  Collective over the file's communicator.
void stamp(Hdf5File& file, const Origin& origin);

}   // namespace cablenet::output
