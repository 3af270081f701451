#include "cablenet/network/economy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cablenet/environment/water.hpp"

namespace cablenet::network {
namespace {

constexpr std::size_t most_named = 3;

/// A cable is drawn straight where no node lies further from the line than this part of its length.
constexpr double straight = 1e-9;

/// At so many instants a motion is looked at.
constexpr int looks = 65;

class DrawnEconomy {
public:
  DrawnEconomy(const scene::Scene& scene, const Network& network)
      : scene_(scene), network_(network), has_taps_(scene.cables.size(), false) {
    for (const scene::Cable& cable : scene.cables)
      for (const scene::CableEnd& end : {cable.from, cable.to})
        if (const auto* tap = std::get_if<scene::TapEnd>(&end)) has_taps_[at(tap->cable)] = true;
  }

  std::string of_straight_cables() const {
    if (scene_.gravity != 0 || scene_.fluid || scene_.bed) return {};
    std::vector<std::string> names;
    std::size_t nodes = network_.prescribed.size();   // that have no unknowns then
    for (std::size_t i = 0; i < scene_.cables.size(); ++i) {
      if (!stays_straight(i)) continue;
      const int elements = network_.spans[i].elements;
      names.push_back(fmt::format("{} ({})", scene_.cables[i].name, elements));
      nodes += at(elements - 1);
    }
    if (names.empty() || nodes == at(network_.position.size())) return {};
    return fmt::format("elements: 1 does for {}: without gravity, water and bed nothing bends {}", first_of(names),
                       names.size() == 1 ? "it" : "them");
  }

  std::string of_bodies() const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i)
      if (never_turns(i)) names.push_back(scene_.bodies[i].name);
    if (names.empty()) return {};
    return fmt::format("no inertia is needed for {}: cables pull at the centre of gravity, and nothing turns {}",
                       first_of(names), names.size() == 1 ? "it" : "them");
  }

private:
  /// Held, and in the same place at all instants that are looked at.
  bool is_held(SceneNode node) const {
    const auto held = std::find_if(network_.prescribed.begin(), network_.prescribed.end(),
                                   [&](const PrescribedNode& one) { return one.node == node; });
    if (held == network_.prescribed.end()) return false;
    const double start = scene_.time.start, span = scene_.is_static ? 0 : scene_.time.end - start;
    for (int i = 0; i < looks; ++i) {
      const scene::Kinematics now = held->motion.at(start + span * i / (looks - 1));
      if (now.x != network_.position[node] || !now.v.isZero(0)) return false;
    }
    return true;
  }

  /// A cable that is drawn straight and at rest between two fixed points stays so.
  bool stays_straight(std::size_t index) const {
    const scene::Cable& cable = scene_.cables[index];
    const Span& span = network_.spans[index];
    if (span.elements == 1 || has_taps_[index] || cable.tension || !cable.node_velocity.empty()) return false;
    const SceneNode from = network_.elements[at(span.first_element)].node[0];
    const SceneNode to = network_.elements[at(span.first_element + span.elements - 1)].node[1];
    return !is_slack(span) && is_drawn_straight(span, from, to) && is_held(from) && is_held(to);
  }

  bool is_slack(const Span& span) const {
    double length = 0;
    for (int i = 0; i < span.elements; ++i) length += network_.elements[at(span.first_element + i)].length;
    const SceneNode from = network_.elements[at(span.first_element)].node[0];
    const SceneNode to = network_.elements[at(span.first_element + span.elements - 1)].node[1];
    return (network_.position[to] - network_.position[from]).norm() < length;
  }

  bool is_drawn_straight(const Span& span, SceneNode from, SceneNode to) const {
    const Vector3 start = network_.position[from], line = network_.position[to] - start;
    for (int i = 1; i < span.elements; ++i) {
      const SceneNode node = network_.elements[at(span.first_element + i)].node[0];
      const Vector3 way = network_.position[node] - start;
      if (way.cross(line).norm() > straight * line.squaredNorm()) return false;
    }
    return true;
  }

  bool never_turns(std::size_t index) const {
    const scene::Body& body = scene_.bodies[index];
    if (!body.inertia || scene_.bed || !body.torque.isZero(0) || !body.angular_velocity.isZero(0)) return false;
    if (scene_.fluid && body.volume > 0 && !body.center_of_buoyancy.isZero(0)) return false;
    for (const scene::Cable& cable : scene_.cables)
      for (const scene::CableEnd& end : {cable.from, cable.to}) {
        const auto* at_body = std::get_if<scene::BodyEnd>(&end);
        if (at_body == nullptr || at(at_body->body) != index) continue;
        if (!body.attachments[at(at_body->attachment)].offset.isZero(0)) return false;
      }
    return true;
  }

  const scene::Scene& scene_;
  const Network& network_;
  std::vector<bool> has_taps_;
};

}   // namespace

std::string first_of(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), most_named); ++i) {
    const bool is_last = i + 1 == names.size();
    text += (i == 0 ? "" : is_last ? " and " : ", ") + names[i];
  }
  return names.size() > most_named ? fmt::format("{} and {} more", text, names.size() - most_named) : text;
}

std::string faint_waves(const scene::Scene& scene, double z, const std::string& where) {
  if (!scene.fluid || scene.is_static) return {};
  const std::size_t waves = scene.fluid->waves.size();
  const std::vector<std::size_t> all = environment::faint_waves(*scene.fluid, z, faint);
  if (all.empty()) return {};
  std::vector<std::string> numbers;
  for (const std::size_t i : all) numbers.push_back(std::to_string(i + 1));
  const bool is_one = all.size() == 1;
  return fmt::format("{} of {} waves {} less than {:.1g} % of the water's motion {}: leave out wave{} {}", all.size(),
                     waves, is_one ? "adds" : "together add", 100 * faint, where, is_one ? "" : "s", first_of(numbers));
}

std::vector<std::string> drawn_economy(const scene::Scene& scene, const Network& network) {
  const DrawnEconomy economy(scene, network);
  std::vector<std::string> found;
  const std::string waves =
      scene.fluid && scene.fluid->surface ? faint_waves(scene, *scene.fluid->surface, "at the surface") : "";
  for (const std::string& text : {waves, economy.of_straight_cables(), economy.of_bodies()})
    if (!text.empty()) found.push_back(text);
  return found;
}

}   // namespace cablenet::network
