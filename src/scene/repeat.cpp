#include <fmt/format.h>

#include "parts.hpp"

namespace cablenet::scene {

namespace {

using Target = Reference::Target;

const Reference& repeated_end(const CableDraft& draft) {
  const bool one_tap = (draft.from.target == Target::cable) != (draft.to.target == Target::cable);
  const Reference& other = draft.from.target == Target::cable ? draft.to : draft.from;
  if (!one_tap || other.target != Target::named)
    draft.repeat->value.fail(
        "this cable cannot be repeated; expected one end {cable: NAME, at: s} and one end at a "
        "point or a body's attachment. Change its ends or remove repeat.");
  return other;
}

template <class D>
using DraftsByName = std::unordered_map<std::string, D*>;

template <class D>
DraftsByName<D> by_name(std::vector<D>& drafts) {
  DraftsByName<D> table;
  for (D& draft : drafts) table[draft.thing.name] = &draft;
  return table;
}

/// A name that is not in the table is reported where ends are resolved.
template <class D>
void mark(const DraftsByName<D>& table, const std::string& name, const char* kind, const CableDraft& cable,
          const Value& end) {
  const auto found = table.find(name);
  if (found == table.end()) return;
  D& draft = *found->second;
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

void shift(Body& body, const Vector3& by) { body.position += by; }

template <class D>
auto expand(const std::vector<D>& drafts, Names& names) {
  using Thing = decltype(D::thing);
  std::vector<Thing> things;
  for (const D& draft : drafts) {
    names.add(draft.thing.name, static_cast<int>(things.size()), draft.copies);
    if (draft.copies == 0) things.push_back(draft.thing);
    for (int k = 0; k < draft.copies; ++k) {
      Thing copy = draft.thing;
      copy.name += fmt::format("[{}]", k);
      shift(copy, k * draft.offset);
      things.push_back(std::move(copy));
    }
  }
  return things;
}

}   // namespace

void mark_repeated(const std::vector<CableDraft>& cables, std::vector<PointDraft>& points,
                   std::vector<BodyDraft>& bodies) {
  const DraftsByName<PointDraft> point_table = by_name(points);
  const DraftsByName<BodyDraft> body_table = by_name(bodies);
  for (const CableDraft& cable : cables) {
    if (!cable.repeat) continue;
    const Reference& end = repeated_end(cable);
    if (end.name.find('[') != std::string::npos)
      end.value.refuse("a point or a body that is not itself a copy", "Give the repeated cable one of its own.");
    mark(point_table, end.name, "point", cable, end.value);
    if (const auto parts = split_attachment(end.name)) mark(body_table, parts->body, "body", cable, end.value);
  }
}

std::vector<Point> expand_points(const std::vector<PointDraft>& drafts, Names& points) {
  return expand(drafts, points);
}

std::vector<Body> expand_bodies(const std::vector<BodyDraft>& drafts, Names& bodies) { return expand(drafts, bodies); }

}   // namespace cablenet::scene
