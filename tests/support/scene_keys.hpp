#pragma once
#include <yaml-cpp/yaml.h>

#include <functional>
#include <string>
#include <vector>

#include "cablenet/scene/keys.hpp"

/// A scene file that is changed at one key, and everywhere that a key stands in it.
namespace cablenet::test {

using scene::Form;
using scene::Key;
using scene::KeyTable;

/// The way from the top of the file to a value: names of keys and, as "[3]", places in lists.
using Path = std::vector<std::string>;

inline Path operator/(Path path, const std::string& step) {
  path.push_back(step);
  return path;
}

inline std::string place_in_list(std::size_t i) {
  std::string step = "[";
  return step.append(std::to_string(i)).append("]");
}

/// As messages write it.
inline std::string written(const Path& path) {
  std::string text;
  for (const std::string& step : path) text += (text.empty() || step[0] == '[' ? "" : ".") + step;
  return text;
}

inline YAML::Node at(const YAML::Node& node, const Path& path, std::size_t first = 0) {
  if (first == path.size()) return node;
  const std::string& step = path[first];
  return at(step[0] == '[' ? node[std::stoi(step.substr(1))] : node[step], path, first + 1);
}

/// The file with the value at `path` replaced.
inline YAML::Node with(const YAML::Node& file, const Path& path, const YAML::Node& value) {
  YAML::Node copy = YAML::Clone(file);
  const Path parent(path.begin(), path.end() - 1);
  const std::string& step = path.back();
  if (step[0] == '[')
    at(copy, parent)[std::stoi(step.substr(1))] = YAML::Clone(value);
  else
    at(copy, parent)[step] = YAML::Clone(value);
  return copy;
}

/// The file without the key at `path`.
inline YAML::Node without(const YAML::Node& file, const Path& path) {
  YAML::Node copy = YAML::Clone(file);
  at(copy, Path(path.begin(), path.end() - 1)).remove(path.back());
  return copy;
}

/// Where a file has a key.
struct Spot {
  YAML::Node file;
  Path path;
};
inline YAML::Node at(const Spot& spot) { return at(spot.file, spot.path); }
inline YAML::Node with(const Spot& spot, const YAML::Node& value) { return with(spot.file, spot.path, value); }
inline YAML::Node without(const Spot& spot) { return without(spot.file, spot.path); }

/// A row of a table and where files have it.
struct Known {
  const KeyTable* table;
  const Key* key;
  std::string name;   ///< "environment.fluid.density", with * for names and places in lists
  std::vector<Spot> spots;
};

class KnownKeys {
public:
  KnownKeys(const KeyTable& top, const std::vector<YAML::Node>& files) {
    std::vector<Found> tops;
    for (const YAML::Node& file : files) tops.push_back({{file, {}}, file});
    add(top, "", tops);
  }
  const std::vector<Known>& all() const { return known_; }

private:
  struct Found {
    Spot spot;
    YAML::Node node;
  };
  static Found inside(const Found& outer, const std::string& step, const YAML::Node& node) {
    return {{outer.spot.file, outer.spot.path / step}, node};
  }

  void add(const KeyTable& table, const std::string& name, const std::vector<Found>& sections) {
    for (const Key& key : table.keys) {
      std::vector<Found> values;
      Known known{&table, &key, name.empty() ? key.name : name + "." + key.name, {}};
      for (const Found& section : sections) {
        const YAML::Node node = section.node[key.name];
        if (!node.IsDefined()) continue;
        values.push_back(inside(section, key.name, node));
        known.spots.push_back(values.back().spot);
      }
      known_.push_back(known);
      add(key.form, known.name, values);
    }
  }

  void add(const Form& form, const std::string& name, const std::vector<Found>& values) {
    std::vector<Found> inner;
    if (const auto* section = std::get_if<scene::SectionForm>(&form.details)) {
      for (const Found& value : values)
        if (value.node.IsMap()) inner.push_back(value);
      add(*section->table, name, inner);
    }
    if (const auto* either = std::get_if<scene::EitherForm>(&form.details))
      for (const Form& one : either->forms) add(one, name, values);
    for (const Found& value : values) {
      if (std::holds_alternative<scene::MapForm>(form.details))
        for (const auto& pair : value.node) inner.push_back(inside(value, pair.first.as<std::string>(), pair.second));
      if (std::holds_alternative<scene::ListForm>(form.details))
        for (std::size_t i = 0; i < value.node.size(); ++i)
          inner.push_back(inside(value, place_in_list(i), value.node[i]));
    }
    if (const auto* map = std::get_if<scene::MapForm>(&form.details)) add(map->item[0], name + ".*", inner);
    if (const auto* list = std::get_if<scene::ListForm>(&form.details)) add(list->item[0], name + "[*]", inner);
  }

  std::vector<Known> known_;
};

}   // namespace cablenet::test
