#include <fmt/format.h>

#include "parts.hpp"

namespace cablenet::scene {

namespace {

using Kind = Reference::Kind;

/// One draft's cables; the ends are those of its first copy.
struct Ends {
  CableEnd from, to;
};

class Resolver {
public:
  Resolver(const Scene& scene, const SceneNames& names) : scene_(scene), names_(names) {}

  Ends ends(const CableDraft& draft) const {
    const bool is_repeated = draft.repeat.has_value();
    return {end(draft.from, is_repeated), end(draft.to, is_repeated)};
  }

private:
  CableEnd end(const Reference& reference, bool is_repeated) const {
    if (reference.kind == Kind::cable) return TapEnd{names_.cables.one(reference.value, reference.name), reference.at};
    if (reference.kind == Kind::net) return net_end(reference);
    if (is_repeated && names_.points.has(reference.name)) return PointEnd{names_.points.find(reference.name)->first};
    if (!names_.points.find(reference.name) && reference.name.find('.') != std::string::npos)
      reference.value.fail(
          fmt::format("{}: an attachment of a body is not supported yet. Use a point.", reference.name));
    return PointEnd{names_.points.one(reference.value, reference.name)};
  }

  CableEnd net_end(const Reference& reference) const {
    const int index = names_.nets.one(reference.value, reference.name);
    const auto& meshes = scene_.nets[static_cast<std::size_t>(index)].meshes;
    if (reference.node[0] > meshes[0] || reference.node[1] > meshes[1])
      reference.value.fail(fmt::format("node [{}, {}] is not allowed; expected [0..{}, 0..{}] in net {}. Correct it.",
                                       reference.node[0], reference.node[1], meshes[0], meshes[1], reference.name));
    return NetEnd{index, reference.node};
  }

  const Scene& scene_;
  const SceneNames& names_;
};

void move_end(CableEnd& end, const Repeat& repeat, int k) {
  if (auto* tap = std::get_if<TapEnd>(&end)) tap->at += k * repeat.every;
  if (auto* point = std::get_if<PointEnd>(&end)) point->point += k;
}

void add_copies(const CableDraft& draft, const Ends& ends, std::vector<Cable>& cables) {
  Cable cable = draft.cable;
  cable.from = ends.from;
  cable.to = ends.to;
  if (!draft.repeat) {
    cables.push_back(std::move(cable));
    return;
  }
  for (int k = 0; k < draft.repeat->count; ++k) {
    Cable copy = cable;
    copy.name += fmt::format("[{}]", k);
    move_end(copy.from, *draft.repeat, k);
    move_end(copy.to, *draft.repeat, k);
    for (Vector3& row : copy.polyline) row += k * draft.repeat->offset;
    cables.push_back(std::move(copy));
  }
}

/// @throws InputError if the tap is off its host; within rounding of the host's end it is put there.
void check_tap(const Reference& reference, const std::string& name, CableEnd& end, const std::vector<Cable>& cables) {
  auto* tap = std::get_if<TapEnd>(&end);
  if (tap == nullptr) return;
  const Cable& host = cables[static_cast<std::size_t>(tap->cable)];
  const double rounding = 1e-12 * host.length.value_or(tap->at);
  if (tap->at < -rounding || (host.length && tap->at > *host.length + rounding))
    reference.value.fail(
        fmt::format("{} is tapped at {} m, off {}; expected a place in 0..{} [m]. Correct at, every, "
                    "count or the length.",
                    name, tap->at, host.name, host.length ? fmt::format("{}", *host.length) : "its length"));
  tap->at = std::max(tap->at, 0.0);
  if (host.length) tap->at = std::min(tap->at, *host.length);
}

}   // namespace

std::vector<Cable> expand_cables(const std::vector<CableDraft>& drafts, const Scene& scene, SceneNames& names) {
  int next = 0;
  for (const CableDraft& draft : drafts) {
    names.cables.add(draft.cable.name, next, draft.repeat ? draft.repeat->count : 0);
    next += draft.copies();
  }
  const Resolver resolver(scene, names);
  std::vector<Cable> cables;
  cables.reserve(static_cast<std::size_t>(next));
  for (const CableDraft& draft : drafts) add_copies(draft, resolver.ends(draft), cables);
  std::size_t i = 0;
  for (const CableDraft& draft : drafts) {
    for (int k = 0; k < draft.copies(); ++k, ++i) {
      check_tap(draft.from, cables[i].name, cables[i].from, cables);
      check_tap(draft.to, cables[i].name, cables[i].to, cables);
    }
  }
  return cables;
}

}   // namespace cablenet::scene
