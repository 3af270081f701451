#include "layout.hpp"

#include <fmt/format.h>

namespace cablenet::output {

std::string segment_name(int segment) { return fmt::format("frames_{:04}.h5", segment); }
std::string frame_name(std::int64_t frame) { return fmt::format("/frames/{:08}", frame); }

void stamp(Hdf5File& file, const Origin& origin) {
  file.set_attribute("/", "format", "cablenet");
  file.set_attribute("/", "format_version", std::int64_t{1});
  file.set_attribute("/", "length_unit", "m");
  file.set_attribute("/", "version", origin.version);
  file.set_attribute("/", "scene_hash", origin.scene_hash);
}

}   // namespace cablenet::output
