#include <fmt/format.h>

#include <algorithm>

#include "parts.hpp"

namespace cablenet::scene {

namespace {

/// The value of a key in the section of one thing.
Value value_of(const Value& section, const std::string& key) {
  for (const Named& named : read_named(section, "a map of keys"))
    if (named.name == key) return named.value;
  return section;
}

void check_start(const Value& value, const Scene& scene, const std::string& other) {
  if (scene.starts_static) return;
  value.fail(
      fmt::format("is not allowed in a run from rest; expected {}, as what is found by a tension is found in an "
                  "equilibrium. Give {}, or initial: static, or no time.",
                  other, other));
}

void check_tap(const Reference& end, const std::vector<CableDraft>& drafts) {
  if (end.target != Reference::Target::cable) return;
  const std::string name = end.name.substr(0, end.name.find('['));
  const auto host =
      std::find_if(drafts.begin(), drafts.end(), [&](const CableDraft& draft) { return draft.cable.name == name; });
  if (host == drafts.end() || !host->cable.tension) return;
  end.value.fail(
      fmt::format("{} has a tension, and its length is not known before it is solved; expected a cable of a given "
                  "length. Give it length, or divide it at a point.",
                  name));
}

}   // namespace

void check_pretensions(const std::vector<CableDraft>& drafts, const std::optional<Value>& nets, const Scene& scene) {
  for (const CableDraft& draft : drafts) {
    if (draft.cable.tension) check_start(value_of(draft.value, "tension"), scene, "length");
    check_tap(draft.from, drafts);
    check_tap(draft.to, drafts);
  }
  if (!nets) return;
  const std::vector<Named> sections = read_named(*nets, "a map from names to nets");
  for (std::size_t i = 0; i < sections.size(); ++i)
    if (scene.nets[i].prestress) check_start(value_of(sections[i].value, "prestress"), scene, "slack");
}

}   // namespace cablenet::scene
