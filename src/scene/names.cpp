#include <fmt/format.h>

#include <charconv>

#include "names.hpp"
#include "spelling.hpp"

namespace cablenet::scene {

namespace {

struct Indexed {
  std::string name;
  int index;
};

/// Splits "branch[2]"; nothing if `text` has no such form.
std::optional<Indexed> split(const std::string& text) {
  const std::size_t bracket = text.find('[');
  if (bracket == std::string::npos || text.back() != ']') return std::nullopt;
  int index = 0;
  const char* last = text.data() + text.size() - 1;
  const auto result = std::from_chars(text.data() + bracket + 1, last, index);
  if (result.ec != std::errc() || result.ptr != last || index < 0) return std::nullopt;
  return Indexed{text.substr(0, bracket), index};
}

std::string copies_of(const std::string& name, int copies) {
  std::vector<std::string> names;
  for (int k = 0; k < std::min(copies, 10); ++k) names.push_back(fmt::format("{}[{}]", name, k));
  return listed(names) + (copies > 10 ? fmt::format(" .. {}[{}]", name, copies - 1) : "");
}

}   // namespace

std::optional<AttachmentName> split_attachment(const std::string& text) {
  const std::size_t dot = text.find('.');
  if (dot == std::string::npos) return std::nullopt;
  return AttachmentName{text.substr(0, dot), text.substr(dot + 1)};
}

void Names::add(const std::string& name, int first, int copies) {
  table_[name] = {first, copies};
  names_.push_back(name);
}

std::optional<std::pair<int, int>> Names::find(const std::string& name) const {
  if (const auto found = table_.find(name); found != table_.end())
    return std::pair{found->second.first, found->second.copies == 0 ? 1 : found->second.copies};
  const auto indexed = split(name);
  if (!indexed) return std::nullopt;
  const auto found = table_.find(indexed->name);
  if (found == table_.end() || indexed->index >= found->second.copies) return std::nullopt;
  return std::pair{found->second.first + indexed->index, 1};
}

int Names::one(const Value& value, const std::string& name) const {
  const auto listed_as = table_.find(name);
  if (listed_as != table_.end() && listed_as->second.copies > 0)
    value.fail(fmt::format("{} is a repeated {}; expected one of its copies: {}. Name one of them.", name, kind_,
                           copies_of(name, listed_as->second.copies)));
  if (const auto found = find(name)) return found->first;
  const auto indexed = split(name);
  const auto base = indexed ? table_.find(indexed->name) : table_.end();
  if (base != table_.end() && base->second.copies == 0)
    value.fail(fmt::format("{} is not allowed: {} is not repeated, so it has no copies. Write {}.", name, indexed->name,
                           indexed->name));
  if (base != table_.end())
    value.fail(fmt::format("{} is no {}; expected one of the copies: {}. Name one of them.", name, kind_,
                           copies_of(indexed->name, base->second.copies)));
  if (names_.empty()) value.fail(fmt::format("{} is no {}; there are none in this scene. Add it.", name, kind_));
  value.fail(fmt::format("{} is no {}; expected one of: {}.{} Correct the name or add it.", name, kind_, listed(names_),
                         did_you_mean(name, names_)));
}

}   // namespace cablenet::scene
