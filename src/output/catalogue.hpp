#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "layout.hpp"

/// The files that a user opens are cables.xmf and bodies.xmf for ParaView, and result.h5 for everyone else.  They list
/// the closed segments.
namespace cablenet::output {

/// The numbers of nodes, elements and bodies on all ranks together.
struct Totals {
  std::int64_t nodes;
  std::int64_t elements;
  std::int64_t bodies;
};

/// Writes these files.  Rank 0 alone uses it; nothing here is collective.
class Catalogue {
public:
  Catalogue(std::filesystem::path directory, Origin origin, const Totals& totals);

  /// Adds a frame to the open segment.  @param time [s]
  void add_frame(double time);
  /// Rewrites the files, which then list the frames of the open segment too.  @pre the segment has its final name
  /// @throws OutputError
  void close_segment();

private:
  void write_result() const;
  void write_xdmf() const;

  std::filesystem::path directory_;
  Origin origin_;
  Totals totals_;
  std::int64_t frames_ = 0;
  std::vector<std::int64_t> ends_;   ///< per closed segment: the number of its last frame plus one
  /// The .xmf texts of all frames.  They are kept because making them anew each time would cost more.
  std::string cable_steps_, body_steps_;
};

}   // namespace cablenet::output
