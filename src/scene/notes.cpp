#include <fmt/format.h>

#include <algorithm>

#include "parts.hpp"
#include "spelling.hpp"

namespace cablenet::scene {

namespace {

/// The cables that end at each attachment of each body.
class Usage {
public:
  explicit Usage(const Scene& scene) : scene_(scene) {
    std::size_t attachments = 0;
    for (const Body& body : scene.bodies) {
      first_.push_back(attachments);
      attachments += body.attachments.size();
    }
    cables_.resize(attachments);
    for (std::size_t i = 0; i < scene.cables.size(); ++i)
      for (const CableEnd* end : {&scene.cables[i].from, &scene.cables[i].to})
        if (const auto* at = std::get_if<BodyEnd>(end))
          cables_[first_[static_cast<std::size_t>(at->body)] + static_cast<std::size_t>(at->attachment)].push_back(i);
  }

  std::vector<std::string> names(std::size_t body, std::size_t attachment) const {
    std::vector<std::string> names;
    for (const std::size_t i : cables_[first_[body] + attachment]) names.push_back(scene_.cables[i].name);
    return names;
  }
  std::size_t count(std::size_t body, std::size_t attachment) const {
    return cables_[first_[body] + attachment].size();
  }

private:
  const Scene& scene_;
  std::vector<std::size_t> first_;   ///< per body, its first attachment in cables_
  std::vector<std::vector<std::size_t>> cables_;
};

/// A draft's bodies are alike, so one of them speaks for all.
class BodyNotes {
public:
  BodyNotes(const BodyDraft& draft, std::size_t first, const Scene& scene, const Usage& usage)
      : draft_(draft), first_(first), scene_(scene), usage_(usage) {}

  void add(std::vector<std::string>& notes) const {
    const auto& attachments = draft_.thing.attachments;
    std::vector<std::string> unused;
    for (std::size_t k = 0; k < attachments.size(); ++k)
      if (usage_.count(busiest(k), k) == 0) unused.push_back(draft_.thing.name + "." + attachments[k].name);
    if (unused.size() == attachments.size()) {
      const std::string remedy = unused.empty() ? "" : fmt::format("; to hold it, end a cable at {}", listed(unused));
      notes.push_back(draft_.value.said(fmt::format("no cable is attached to it: it moves freely{}", remedy)));
      return;
    }
    for (std::size_t k = 0; k < attachments.size(); ++k) add(k, notes);
    add_energy(notes);
  }

private:
  bool has_bars() const {
    const Body& body = draft_.thing;
    if (!body.link || body.link->kind != Link::Kind::bar) return false;
    for (std::size_t k = 0; k < body.attachments.size(); ++k)
      if (!body.attachments[k].offset.isZero(0) && usage_.count(busiest(k), k) > 0) return true;
    return false;
  }

  void add_energy(std::vector<std::string>& notes) const {
    if (scene_.is_static || !scene_.output.energy || !draft_.thing.inertia || !has_bars()) return;
    notes.push_back(draft_.value.said(
        "a bar turns the body by r x F, which has no potential: energy.total is not conserved, but changes by the work "
        "of that moment"));
  }

  void add(std::size_t k, std::vector<std::string>& notes) const {
    const Body& body = draft_.thing;
    const auto note = [&](const std::string& text) { notes.push_back(draft_.attachments[k].said(text)); };
    const bool is_central = body.attachments[k].offset.isZero(0);
    const std::vector<std::string> cables = usage_.names(busiest(k), k);
    if (cables.empty()) {
      note("no cable ends at this attachment");
      return;
    }
    if (cables.size() > 1)
      note(fmt::format("{}.{} carries {} cables: {}; each is hinged there by itself", scene_.bodies[busiest(k)].name,
                       body.attachments[k].name, cables.size(), listed(cables)));
    if (!body.inertia && !is_central)
      note(
          "a body without inertia does not turn: the attachment keeps its offset in fixed directions; give inertia if "
          "it should swing");
    if (body.link && is_central)
      note(fmt::format(
          "it is at the centre of gravity and a {} needs a length: this attachment is coupled kinematically",
          body.link->kind == Link::Kind::bar ? "bar" : "link"));
  }

  /// The copy on whose k-th attachment most cables end.
  std::size_t busiest(std::size_t k) const {
    std::size_t best = first_;
    for (std::size_t i = first_; i < first_ + static_cast<std::size_t>(std::max(draft_.copies, 1)); ++i)
      if (usage_.count(i, k) > usage_.count(best, k)) best = i;
    return best;
  }

  const BodyDraft& draft_;
  std::size_t first_;
  const Scene& scene_;
  const Usage& usage_;
};

const Value* first_drawn_moving(const std::vector<PointDraft>& points, const std::vector<BodyDraft>& bodies,
                                const std::vector<CableDraft>& cables) {
  const auto moves = [](const Vector3& velocity) { return !velocity.isZero(0); };
  for (const PointDraft& point : points)
    if (moves(point.thing.velocity)) return &point.value;
  for (const BodyDraft& body : bodies)
    if (moves(body.thing.velocity) || moves(body.thing.angular_velocity)) return &body.value;
  for (const CableDraft& cable : cables)
    if (std::any_of(cable.cable.node_velocity.begin(), cable.cable.node_velocity.end(), moves)) return &cable.value;
  return nullptr;
}

}   // namespace

void add_body_notes(const std::vector<BodyDraft>& bodies, const std::vector<CableDraft>& cables, Scene& scene) {
  std::vector<std::string>& notes = scene.notes;
  const Usage usage(scene);
  std::size_t first = 0;
  for (const BodyDraft& draft : bodies) {
    BodyNotes(draft, first, scene, usage).add(notes);
    first += static_cast<std::size_t>(std::max(draft.copies, 1));
  }
  first = 0;
  for (const CableDraft& draft : cables) {
    const auto* from = std::get_if<BodyEnd>(&scene.cables[first].from);
    const auto* to = std::get_if<BodyEnd>(&scene.cables[first].to);
    if (from != nullptr && to != nullptr && from->body == to->body)
      notes.push_back(draft.value.said(
          fmt::format("its ends, {} and {}, are on one body; end it elsewhere if it should hold the body to something",
                      draft.from.name, draft.to.name)));
    first += static_cast<std::size_t>(draft.copies());
  }
}

void add_force_notes(const std::vector<PointDraft>& points, Scene& scene) {
  for (const PointDraft& draft : points) {
    if (!draft.thing.force_law) continue;
    if (draft.thing.motion)
      scene.notes.push_back(
          draft.value.said("the point goes where its motion says: the force changes what holds it alone"));
    if (scene.is_static)
      scene.notes.push_back(draft.value.said(
          fmt::format("a scene without time is solved at t = {} s: the force is what it is then", scene.time.start)));
  }
}

void add_static_notes(const std::vector<PointDraft>& points, const std::vector<BodyDraft>& bodies,
                      const std::vector<CableDraft>& cables, Scene& scene) {
  const Value* moving = scene.is_static ? first_drawn_moving(points, bodies, cables) : nullptr;
  if (moving == nullptr) return;
  scene.notes.push_back(
      moving->said("a drawn velocity does nothing in a scene without time: its equilibrium is solved"));
}

}   // namespace cablenet::scene
