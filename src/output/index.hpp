#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "layout.hpp"

/// What a user opens: cables.xmf for ParaView and result.h5 for everyone else, over the closed segments.
namespace cablenet::output {

/// Kept by rank 0 alone; nothing here is collective.
class Index {
public:
  Index(std::filesystem::path directory, Origin origin, std::int64_t nodes, std::int64_t elements);

  /// The next frame of the open segment.  @param time [s]
  void add_frame(double time);
  /// The open segment has its final name: both files list its frames from now on.
  /// @throws OutputError
  void close_segment();

private:
  void write_result() const;
  void write_xdmf() const;

  std::filesystem::path directory_;
  Origin origin_;
  std::int64_t nodes_;
  std::int64_t elements_;
  std::int64_t frames_ = 0;
  std::vector<std::int64_t> ends_;   ///< of every closed segment: the number of its last frame plus one
  std::string steps_;                ///< the .xmf text of every frame: to make it anew each time would cost more
};

}   // namespace cablenet::output
