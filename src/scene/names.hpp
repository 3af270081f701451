#pragma once
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "yaml_reader.hpp"

/// What the things of a scene are called.  Tests: tests/unit/read_test.cpp
namespace cablenet::scene {

/// The names of all things of one kind.  A name stands for one thing or for all copies of a repeated one; the copies
/// follow each other in the list of all things, and name[k] is one of them.
class Names {
public:
  explicit Names(std::string kind) : kind_(std::move(kind)) {}   ///< "point", "cable", ... for messages
  /// @param first   its index, or that of its first copy
  /// @param copies  0: a single thing; n: repeated as name[0] .. name[n-1]
  void add(const std::string& name, int first, int copies);
  bool has(const std::string& name) const { return table_.count(name) > 0; }
  /// The first index and the number of things that `name` stands for; nothing if it is not known.
  std::optional<std::pair<int, int>> find(const std::string& name) const;
  /// The index of the one thing that `name` stands for.
  /// @throws InputError at `value` if there is none, or several.
  int one(const Value& value, const std::string& name) const;
  const std::vector<std::string>& all() const { return names_; }

private:
  struct Listed {
    int first, copies;
  };
  std::string kind_;
  std::vector<std::string> names_;
  std::unordered_map<std::string, Listed> table_;
};

/// The names of everything in a scene.
struct SceneNames {
  Names types{"cable type"}, points{"point"}, bodies{"body"}, cables{"cable"}, nets{"net"};
};

/// The two parts of a name such as "fish[2].top".
struct AttachmentName {
  std::string body, attachment;
};
/// The parts of `text`, which the first dot separates; nothing if there is no dot.
std::optional<AttachmentName> split_attachment(const std::string& text);

}   // namespace cablenet::scene
