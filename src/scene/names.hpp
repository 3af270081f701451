#pragma once
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "yaml_reader.hpp"

/// What the things of a scene are called.  Tests: tests/unit/read_test.cpp
namespace cablenet::scene {

/// Names of one kind of thing, and where their copies stand in the expanded list.
class Names {
public:
  explicit Names(std::string kind) : kind_(std::move(kind)) {}   ///< "point", "cable", ... for messages
  /// @param copies  0: a single thing; n: repeated as name[0] .. name[n-1]
  void add(const std::string& name, int first, int copies);
  bool has(const std::string& name) const { return table_.count(name) > 0; }
  /// First index and count of `name`, `name[k]` or all copies of a repeated `name`.
  std::optional<std::pair<int, int>> find(const std::string& name) const;
  /// The one thing that `name` is.  @throws InputError at `value` if there is none, or several.
  int one(const Value& value, const std::string& name) const;
  const std::vector<std::string>& all() const { return names_; }

private:
  struct Extent {
    int first, copies;
  };
  std::string kind_;
  std::vector<std::string> names_;
  std::unordered_map<std::string, Extent> table_;
};

/// The names of everything in a scene.
struct SceneNames {
  Names types{"cable type"}, points{"point"}, bodies{"body"}, cables{"cable"}, nets{"net"};
};

/// The parts of "fish[2].top".
struct AttachmentName {
  std::string body, attachment;
};
/// Nothing if `text` has no dot.
std::optional<AttachmentName> split_attachment(const std::string& text);

}   // namespace cablenet::scene
