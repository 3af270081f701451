#include <fmt/format.h>

#include <algorithm>

#include "parts.hpp"
#include "spelling.hpp"

namespace cablenet::scene {

namespace {

using Target = Reference::Target;

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
    if (reference.target == Target::cable)
      return TapEnd{names_.cables.one(reference.value, reference.name), reference.at};
    if (reference.target == Target::net) return net_end(reference);
    if (is_repeated && names_.points.has(reference.name)) return PointEnd{names_.points.find(reference.name)->first};
    if (names_.points.find(reference.name)) return PointEnd{names_.points.one(reference.value, reference.name)};
    const auto parts = split_attachment(reference.name);
    const bool is_whole = parts && !parts->body.empty() && !parts->attachment.empty();
    if (is_whole) return body_end(reference.value, *parts, is_repeated);
    fail_name(reference.value, parts && parts->attachment.empty() ? parts->body : reference.name);
  }

  BodyEnd body_end(const Value& value, const AttachmentName& parts, bool is_repeated) const {
    if (names_.points.find(parts.body))
      value.fail(fmt::format("{} is a point, which has no attachments; expected its name alone. Write {}.", parts.body,
                             parts.body));
    const bool is_all = is_repeated && names_.bodies.has(parts.body);
    const int index = is_all ? names_.bodies.find(parts.body)->first : names_.bodies.one(value, parts.body);
    const Body& body = scene_.bodies[static_cast<std::size_t>(index)];
    const auto& all = body.attachments;
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& a) { return a.name == parts.attachment; });
    if (found != all.end()) return {index, static_cast<int>(found - all.begin())};
    if (all.empty())
      value.fail(fmt::format("{} has no attachments; expected {} among them. Add attachments: {{{}: [x, y, z]}} to it.",
                             parts.body, parts.attachment, parts.attachment));
    const std::vector<std::string> known = attachments_of(body);
    value.fail(fmt::format("{} has no attachment {}; expected one of: {}.{} Correct the name or add it.", parts.body,
                           parts.attachment, listed(known), did_you_mean(body.name + "." + parts.attachment, known)));
  }

  static std::vector<std::string> attachments_of(const Body& body) {
    std::vector<std::string> names;
    for (const Attachment& attachment : body.attachments) names.push_back(body.name + "." + attachment.name);
    return names;
  }

  /// Of a name without attachment.
  [[noreturn]] void fail_name(const Value& value, const std::string& name) const {
    if (const auto body = names_.bodies.find(name)) fail_body(value, name, body->first);
    if (scene_.bodies.empty() || names_.points.has(name.substr(0, name.find('[')))) names_.points.one(value, name);
    std::vector<std::string> known = names_.points.all();
    for (const Body& body : scene_.bodies)
      for (std::string& attachment : attachments_of(body)) known.push_back(std::move(attachment));
    std::vector<std::string> similar = known;
    similar.insert(similar.end(), names_.bodies.all().begin(), names_.bodies.all().end());
    value.fail(fmt::format("{} is no point and no attachment; expected one of: {}.{} Correct the name or add it.", name,
                           listed(known), did_you_mean(name, similar)));
  }

  [[noreturn]] void fail_body(const Value& value, const std::string& name, int index) const {
    const Body& body = scene_.bodies[static_cast<std::size_t>(index)];
    if (body.attachments.empty())
      value.fail(
          fmt::format("{} is a body without attachments; expected one of a body's attachments. Add attachments: "
                      "{{top: [0, 0, 0]}} to it and write {}.top.",
                      name, body.name));
    value.fail(fmt::format("{} is a body; expected one of its attachments: {}. Name one of them.", name,
                           listed(attachments_of(body))));
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
  if (auto* on_body = std::get_if<BodyEnd>(&end)) on_body->body += k;
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
