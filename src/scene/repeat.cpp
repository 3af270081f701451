#include <fmt/format.h>

#include "parts.hpp"

namespace cablenet::scene {

namespace {

using Kind = Reference::Kind;

const Reference& repeated_end(const CableDraft& draft) {
  const bool one_tap = (draft.from.kind == Kind::cable) != (draft.to.kind == Kind::cable);
  const Reference& other = draft.from.kind == Kind::cable ? draft.to : draft.from;
  if (!one_tap || other.kind != Kind::point)
    draft.repeat->value.fail(
        "this cable cannot be repeated; expected one end {cable: NAME, at: s} and one end at a "
        "point. Change its ends or remove repeat.");
  return other;
}

template <class T>
using Drafts = std::unordered_map<std::string, Draft<T>*>;

template <class T>
Drafts<T> by_name(std::vector<Draft<T>>& drafts) {
  Drafts<T> table;
  for (Draft<T>& draft : drafts) table[draft.thing.name] = &draft;
  return table;
}

/// A name that is not in the table is reported where ends are resolved.
template <class T>
void mark(const Drafts<T>& table, const std::string& name, const char* kind, const CableDraft& cable,
          const Value& end) {
  const auto found = table.find(name);
  if (found == table.end()) return;
  Draft<T>& draft = *found->second;
  if (draft.copies > 0)
    end.fail(fmt::format("{} is already repeated by cable {}; expected a {} of its own. Add one.", name,
                         draft.repeated_by, kind));
  draft.copies = cable.repeat->count;
  draft.offset = cable.repeat->offset;
  draft.repeated_by = cable.cable.name;
}

void shift(Point& point, const Vector3& by) {
  point.position += by;
  if (point.motion) point.motion = point.motion->shifted(by);
}

template <class T>
std::vector<T> expand(const std::vector<Draft<T>>& drafts, Names& names) {
  std::vector<T> things;
  for (const Draft<T>& draft : drafts) {
    names.add(draft.thing.name, static_cast<int>(things.size()), draft.copies);
    if (draft.copies == 0) things.push_back(draft.thing);
    for (int k = 0; k < draft.copies; ++k) {
      T copy = draft.thing;
      copy.name += fmt::format("[{}]", k);
      shift(copy, k * draft.offset);
      things.push_back(std::move(copy));
    }
  }
  return things;
}

}   // namespace

void mark_repeated(const std::vector<CableDraft>& cables, std::vector<PointDraft>& points) {
  const Drafts<Point> point_table = by_name(points);
  for (const CableDraft& cable : cables) {
    if (!cable.repeat) continue;
    const Reference& end = repeated_end(cable);
    if (end.name.find('[') != std::string::npos)
      end.value.refuse("a point that is not itself a copy", "Give the repeated cable a point of its own.");
    mark(point_table, end.name, "point", cable, end.value);
  }
}

std::vector<Point> expand_points(const std::vector<PointDraft>& drafts, Names& points) {
  return expand(drafts, points);
}

}   // namespace cablenet::scene
