#include <fmt/format.h>

#include <algorithm>

#include "cablenet/scene/keys.hpp"
#include "cablenet/scene/schema.hpp"

namespace cablenet::scene {

namespace {

constexpr auto head = R"(# The keys of a scene file

This file is what `cablenet schema --markdown` prints; the rows of the tables in this folder say it.
Units are SI, angles are in degrees, z is up. A key that is unknown, missing or out of range is refused.
NAME stands for a name of your choice, [i] for an item of a list.
)";

std::string path_of(const std::string& section, const Key& key) {
  return section.empty() ? key.name : fmt::format("{}.{}", section, key.name);
}

/// A table and everywhere that its sections stand in a scene file.
struct Chapter {
  const KeyTable* table;
  std::vector<std::string> paths;
};

/// The chapters in the order in which a reader meets them.
class Chapters {
public:
  explicit Chapters(const KeyTable& top) { add(top, ""); }
  const std::vector<Chapter>& all() const { return chapters_; }

private:
  void add(const KeyTable& table, const std::string& path) {
    const auto found = std::find_if(chapters_.begin(), chapters_.end(),
                                    [&](const Chapter& chapter) { return chapter.table == &table; });
    if (found != chapters_.end()) {
      found->paths.push_back(path);
      return;
    }
    chapters_.push_back({&table, {path}});
    for (const Key& key : table.keys) add(key.form, path_of(path, key));
  }

  void add(const Form& form, const std::string& path) {
    if (const auto* list = std::get_if<ListForm>(&form.details)) add(list->item[0], path + "[i]");
    if (const auto* map = std::get_if<MapForm>(&form.details)) add(map->item[0], path + ".NAME");
    if (const auto* section = std::get_if<SectionForm>(&form.details)) add(*section->table, path);
    if (const auto* either = std::get_if<EitherForm>(&form.details))
      for (const Form& one : either->forms) add(one, path);
  }

  std::vector<Chapter> chapters_;
};

/// A bar would end the cell.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string if_absent(const KeyTable& table, const Key& key) {
  if (key.is_required) return "required";
  if (table.takes_one) return "one of these keys";
  return key.standard.empty() ? key.absent : fmt::format("`{}`", key.standard);
}

std::string value_of(const Chapter& chapter, const Key& key) {
  const bool is_section = std::holds_alternative<SectionForm>(key.form.details);
  return is_section ? fmt::format("a map: see `{}`", path_of(chapter.paths[0], key)) : key.form.expected;
}

std::string row(const Chapter& chapter, const Key& key) {
  const std::string condition = key.needs.empty() ? "" : fmt::format(" With {} only.", key.needs);
  return fmt::format("| `{}` | {} | {} | {}{} |\n", key.name, cell(value_of(chapter, key)),
                     cell(if_absent(*chapter.table, key)), cell(key.sentence), condition);
}

std::string written(const Chapter& chapter) {
  std::string title;
  for (const std::string& path : chapter.paths) title += fmt::format("{}`{}`", title.empty() ? "" : ", ", path);
  std::string text = fmt::format("\n## {}\n\n{}\n\n| key | value | if absent | what it is |\n|---|---|---|---|\n",
                                 chapter.paths[0].empty() ? "The top level" : title, chapter.table->sentence);
  for (const Key& key : chapter.table->keys) text += row(chapter, key);
  return text;
}

}   // namespace

std::string key_reference() {
  std::string text = head;
  const Chapters chapters(scene_keys());
  for (const Chapter& chapter : chapters.all()) text += written(chapter);
  return text;
}

}   // namespace cablenet::scene
