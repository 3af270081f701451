#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "parts.hpp"

namespace cablenet::scene {

namespace {

/// PETSc counts unknowns in 32 bits, three per node.
constexpr std::int64_t most_nodes = 700'000'000;

[[noreturn]] void fail_size(const Value& value) {
  value.fail(
      fmt::format("with this the scene has more than {} nodes; expected at most as many. Reduce elements, meshes "
                  "or count.",
                  most_nodes));
}

using CablesByName = std::unordered_map<std::string, std::size_t>;

/// The drafts that a draft's two ends are tapped on; a draft that does not exist is reported elsewhere.
std::vector<std::size_t> hosts(const CableDraft& draft, const CablesByName& table) {
  std::vector<std::size_t> result;
  for (const Reference* end : {&draft.from, &draft.to}) {
    if (end->target != Reference::Target::cable) continue;
    const auto found = table.find(end->name.substr(0, end->name.find('[')));
    if (found != table.end()) result.push_back(found->second);
  }
  return result;
}

[[noreturn]] void fail_circle(const std::vector<CableDraft>& drafts, const std::vector<std::size_t>& path,
                              std::size_t again) {
  std::vector<std::string> names;
  for (auto i = std::find(path.begin(), path.end(), again); i != path.end(); ++i)
    names.push_back(drafts[*i].cable.name);
  names.push_back(drafts[again].cable.name);
  if (names.size() > 12) names.erase(names.begin() + 10, names.end() - 1);
  drafts[again].value.fail(
      fmt::format("taps go round in a circle: {}; expected each cable tapped on one that does not "
                  "hang on it. End one of them at a point.",
                  fmt::join(names, " -> ")));
}

/// Depth first without recursion, as chains of taps may be as long as the scene.
class CircleSearch {
public:
  CircleSearch(const std::vector<CableDraft>& drafts, const CablesByName& table)
      : drafts_(drafts), table_(table), states_(drafts.size(), State::unseen) {}

  void visit(std::size_t start) {
    if (states_[start] == State::unseen) enter(start);
    while (!path_.empty()) {
      if (open_.back().empty()) {
        states_[path_.back()] = State::done;
        path_.pop_back();
        open_.pop_back();
        continue;
      }
      const std::size_t host = open_.back().back();
      open_.back().pop_back();
      if (states_[host] == State::on_path) fail_circle(drafts_, path_, host);
      if (states_[host] == State::unseen) enter(host);
    }
  }

private:
  enum class State { unseen, on_path, done };

  void enter(std::size_t draft) {
    states_[draft] = State::on_path;
    path_.push_back(draft);
    open_.push_back(hosts(drafts_[draft], table_));
  }

  const std::vector<CableDraft>& drafts_;
  const CablesByName& table_;
  std::vector<State> states_;
  std::vector<std::size_t> path_;
  std::vector<std::vector<std::size_t>> open_;
};

/// Where an end is drawn, if that is known before the cables are laid.
std::optional<Vector3> start_position(const CableEnd& end, const Scene& scene) {
  if (const auto* at = std::get_if<PointEnd>(&end)) {
    const Point& point = scene.points[static_cast<std::size_t>(at->point)];
    return point.motion ? point.motion->at(scene.time.start).x : point.position;
  }
  if (const auto* at = std::get_if<BodyEnd>(&end)) {
    const Body& body = scene.bodies[static_cast<std::size_t>(at->body)];
    return body.position + body.attitude * body.attachments[static_cast<std::size_t>(at->attachment)].offset;
  }
  return std::nullopt;
}

bool ends_coincide(const Cable& cable, const Scene& scene) {
  const auto a = start_position(cable.from, scene), b = start_position(cable.to, scene);
  // A body's attachment is drawn with the rounding of a sum.
  if (a && b) return (*a - *b).norm() <= 1e-12 * (1 + a->norm());
  if (const auto* from = std::get_if<TapEnd>(&cable.from))
    if (const auto* to = std::get_if<TapEnd>(&cable.to)) return from->cable == to->cable && from->at == to->at;
  if (const auto* from = std::get_if<NetEnd>(&cable.from))
    if (const auto* to = std::get_if<NetEnd>(&cable.to)) return from->net == to->net && from->node == to->node;
  return false;
}

void check_one_attachment(const CableDraft& draft, const Cable& cable) {
  const auto* from = std::get_if<BodyEnd>(&cable.from);
  const auto* to = std::get_if<BodyEnd>(&cable.to);
  if (from == nullptr || to == nullptr || from->body != to->body || from->attachment != to->attachment) return;
  draft.value.fail(fmt::format(
      "both its ends are at {}; expected two places. Move one to a point or another attachment.", draft.from.name));
}

void check_straight(const CableDraft& draft, const Cable& cable, const Scene& scene) {
  if (cable.shape != Shape::straight || !ends_coincide(cable, scene)) return;
  draft.value.fail(
      fmt::format("its ends, {} and {}, are at the same place and its shape is straight; expected a line of "
                  "some length. Move an end, or give shape: a polyline [[x, y, z], ...].",
                  draft.from.name, draft.to.name));
}

}   // namespace

void check_size(const std::vector<CableDraft>& cables, const std::vector<Net>& nets, const Value& top) {
  std::int64_t nodes = 0;
  for (const CableDraft& draft : cables) {
    const std::int64_t copies = draft.copies();
    const std::int64_t per_copy = std::int64_t{draft.cable.elements} + 1;
    if (copies > most_nodes / per_copy) fail_size(draft.value);
    nodes += copies * per_copy;
    if (nodes > most_nodes) fail_size(draft.value);
  }
  for (const Net& net : nets) {
    const std::int64_t rows = std::int64_t{net.meshes[1]} + 1;
    const std::int64_t columns = std::int64_t{net.meshes[0]} + 1;
    nodes += columns > most_nodes / rows ? most_nodes + 1 : columns * rows;
    if (nodes > most_nodes) fail_size(top);
  }
}

void check_circles(const std::vector<CableDraft>& drafts) {
  CablesByName table;
  for (std::size_t i = 0; i < drafts.size(); ++i) table[drafts[i].cable.name] = i;
  CircleSearch search(drafts, table);
  for (std::size_t i = 0; i < drafts.size(); ++i) search.visit(i);
}

void check_ends(const std::vector<CableDraft>& drafts, const std::vector<PointDraft>& points, const Scene& scene) {
  std::vector<bool> is_used(scene.points.size(), false);
  std::size_t i = 0;
  for (const CableDraft& draft : drafts) {
    for (int k = 0; k < draft.copies(); ++k, ++i) {
      const Cable& cable = scene.cables[i];
      check_one_attachment(draft, cable);
      check_straight(draft, cable, scene);
      for (const CableEnd* end : {&cable.from, &cable.to})
        if (const auto* point = std::get_if<PointEnd>(end)) is_used[static_cast<std::size_t>(point->point)] = true;
    }
  }
  i = 0;
  for (const PointDraft& draft : points) {
    if (!is_used[i] && !draft.thing.motion)
      draft.value.fail(fmt::format("point {} is attached to nothing: connect a cable or remove it.", draft.thing.name));
    i += static_cast<std::size_t>(std::max(draft.copies, 1));
  }
}

}   // namespace cablenet::scene
