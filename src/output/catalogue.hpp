#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "layout.hpp"

/// What a user opens: cables.xmf and bodies.xmf for ParaView and result.h5 for everyone else, over the closed segments.
namespace cablenet::output {

/// How many there are on all ranks together.
struct Totals {
  std::int64_t nodes;
  std::int64_t elements;
  std::int64_t bodies;
};

/// Kept by rank 0 alone; nothing here is collective.
class Catalogue {
public:
  Catalogue(std::filesystem::path directory, Origin origin, const Totals& totals);

  /// The next frame of the open segment.  @param time [s]
  void add_frame(double time);
  /// The open segment has its final name: the files list its frames from now on.
  /// @throws OutputError
  void close_segment();

private:
  void write_result() const;
  void write_xdmf() const;

  std::filesystem::path directory_;
  Origin origin_;
  Totals totals_;
  std::int64_t frames_ = 0;
  std::vector<std::int64_t> ends_;   ///< of every closed segment: the number of its last frame plus one
  /// The .xmf texts of every frame: to make them anew each time would cost more.
  std::string cable_steps_, body_steps_;
};

}   // namespace cablenet::output
