#include "cablenet/network/drawn_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cablenet::network {
namespace {

/// The strain from which on a cable is drawn much stretched.
constexpr double much = 0.05;

/// What is less deep than this passes for lying on the bed: so many times the smoothing, or of the diameter.
constexpr double smoothings = 10, diameters = 0.1;

/// How far a span's nodes lie inside the bed.
struct Buried {
  double depth = 0;   ///< [m]
  int nodes = 0;
};

/// A point or a body whose contact with the bed lies inside it.
struct Inside {
  std::string place;
  double depth;   ///< [m]
};

/// A span's element that is drawn stretched most.
struct Stretched {
  double strain = 0;
  int element = 0;   ///< of the span, from 0
};

/// The worst of all spans speaks for the others.
template <class Found, class Measure>
std::string others(const std::vector<Found>& all, Measure measure, double least, const char* what) {
  const auto count = std::count_if(all.begin(), all.end(), [&](const Found& one) { return measure(one) > least; });
  return count > 1 ? fmt::format("; so {} {} more", count > 2 ? fmt::format("are {}", count - 1) : "is 1", what) : "";
}

class DrawnNotes {
public:
  DrawnNotes(const scene::Scene& scene, const Network& network)
      : scene_(scene), network_(network), is_held_(network.position.size(), false) {
    for (const PrescribedNode& held : network.prescribed) is_held_[held.node] = true;
  }

  std::string of_bed() const {
    if (!scene_.bed || scene_.starts_static) return {};
    std::vector<Buried> all;
    for (const Span& span : network_.spans) all.push_back(buried(span));
    const auto depth = [](const Buried& one) { return one.depth; };
    const auto worst =
        std::max_element(all.begin(), all.end(), [](const Buried& a, const Buried& b) { return a.depth < b.depth; });
    if (worst == all.end() || worst->depth == 0) return {};
    const auto index = static_cast<std::size_t>(worst - all.begin());
    const bool is_cable = index < scene_.cables.size();
    const bool is_catenary = is_cable && scene_.cables[index].shape == scene::Shape::catenary;
    return fmt::format(
        "{}: it is drawn inside the bed with {} of its nodes, by up to {:.3g} m, which throws them out at the start{}. "
        "Draw it above environment.seabed.level{}, or start from initial: static.",
        place(index), worst->nodes, worst->depth, others(all, depth, 0, "of the scene's cables and nets"),
        is_cable && !is_catenary ? ", as shape: catenary does" : "");
  }

  /// An anchor may lie a little in the bed.  What is held more than an element deep is held where nothing can lie.
  std::string of_held() const {
    if (!scene_.bed) return {};
    Buried worst;
    std::size_t index = 0;
    for (std::size_t i = 0; i < network_.spans.size(); ++i)
      if (const Buried held = held_inside(network_.spans[i]); held.depth > worst.depth) worst = held, index = i;
    if (worst.depth == 0) return {};
    return fmt::format(
        "{}: {} of its fixed or moved nodes {} inside the bed, by up to {:.3g} m, from where the bed pushes out what "
        "hangs there. Put {} above environment.seabed.level, or lower it.",
        place(index), worst.nodes, worst.nodes > 1 ? "start" : "starts", worst.depth, worst.nodes > 1 ? "them" : "it");
  }

  std::string of_spots() const {
    if (!scene_.bed || scene_.starts_static) return {};
    std::vector<Inside> all;
    for (const BedSpot<SceneNode>& spot : network_.bed_spots) note_inside(spot, all);
    const auto depth = [](const Inside& one) { return one.depth; };
    const auto worst =
        std::max_element(all.begin(), all.end(), [](const Inside& a, const Inside& b) { return a.depth < b.depth; });
    if (worst == all.end()) return {};
    return fmt::format(
        "{}: it is drawn inside the bed by {:.3g} m, which throws it out at the start{}. Draw it that much higher "
        "above "
        "environment.seabed.level, or start from initial: static.",
        worst->place, worst->depth, others(all, depth, 0, "of the scene's points and bodies"));
  }

  std::string of_stretch() const {
    std::vector<Stretched> all;
    for (std::size_t i = 0; i < scene_.cables.size(); ++i) all.push_back(stretched(i));
    const auto strain = [](const Stretched& one) { return one.strain; };
    const auto worst = std::max_element(all.begin(), all.end(),
                                        [](const Stretched& a, const Stretched& b) { return a.strain < b.strain; });
    if (worst == all.end() || !(worst->strain > much)) return {};
    const auto index = static_cast<std::size_t>(worst - all.begin());
    const Span& span = network_.spans[index];
    const Element& element = network_.elements[at(span.first_element + worst->element)];
    return fmt::format(
        "{}: it is drawn {:.3g} % stretched in its element {} of {}, which pulls with {:.3g} N{}. Its chords are "
        "{:.6g} m "
        "long in all, and length is {:.6g} m: correct one of them.",
        place(index), 100 * worst->strain, worst->element + 1, span.elements,
        worst->strain * network_.materials[at(element.material)].axial_stiffness,
        others(all, strain, much, "of the scene's cables"), drawn_length(span), unstretched_length(span));
  }

private:
  std::string place(std::size_t span) const {
    if (span < scene_.cables.size())
      return fmt::format("{}: cables.{}", scene_.cables[span].where, scene_.cables[span].name);
    const scene::Net& net = scene_.nets[span - scene_.cables.size()];
    return fmt::format("{}: nets.{}", net.where, net.name);
  }

  double drawn(const Element& e) const { return (network_.position[e.node[1]] - network_.position[e.node[0]]).norm(); }

  /// A body's deepest spot speaks for the others.
  void note_inside(const BedSpot<SceneNode>& spot, std::vector<Inside>& all) const {
    const double depth = scene_.bed->level - network_.position[spot.node].z() + spot.radius;
    if (depth <= std::max(smoothings * spot.smoothing, diameters * std::sqrt(spot.area))) return;
    std::string place = place_of(spot.node);
    if (all.empty() || all.back().place != place) all.push_back({std::move(place), depth});
    all.back().depth = std::max(all.back().depth, depth);
  }

  /// Of a point's node, or of one that a body carries.
  std::string place_of(SceneNode node) const {
    for (std::size_t i = 0; i < scene_.points.size(); ++i)
      if (network_.point_node[i] == node)
        return fmt::format("{}: points.{}", scene_.points[i].where, scene_.points[i].name);
    std::size_t body = 0;
    for (std::size_t i = 0; i < network_.bodies.size(); ++i)
      if (network_.bodies[i].node == node) body = i;
    for (const CarriedNode& carried : network_.carried)
      if (carried.node == node) body = static_cast<std::size_t>(carried.body);
    return fmt::format("{}: bodies.{}", scene_.bodies[body].where, scene_.bodies[body].name);
  }

  Buried buried(const Span& span) const {
    return nodes_inside(span, false, [this](const Element& element) {
      const CableOnBed& on_bed = network_.surroundings.on_bed[at(element.material)];
      return std::max(smoothings * on_bed.smoothing, diameters * on_bed.diameter);
    });
  }

  Buried held_inside(const Span& span) const {
    return nodes_inside(span, true, [](const Element& element) { return element.length; });
  }

  /// The nodes that are held, or those that are not, which lie deeper than `slight` has it for their elements.
  template <class Slight>
  Buried nodes_inside(const Span& span, bool held, const Slight& slight) const {
    double deepest = 0;
    std::vector<SceneNode> nodes;
    for (int i = 0; i < span.elements; ++i) {
      const Element& element = network_.elements[at(span.first_element + i)];
      for (const SceneNode node : element.node) {
        const double depth = scene_.bed->level - network_.position[node].z();
        if (is_held_[node] != held || depth <= slight(element)) continue;
        deepest = std::max(deepest, depth);
        nodes.push_back(node);
      }
    }
    std::sort(nodes.begin(), nodes.end());
    return {deepest, static_cast<int>(std::unique(nodes.begin(), nodes.end()) - nodes.begin())};
  }

  Stretched stretched(std::size_t cable) const {
    if (scene_.cables[cable].tension) return {};
    const Span& span = network_.spans[cable];
    const Element& first = network_.elements[at(span.first_element)];
    const Element& last = network_.elements[at(span.first_element + span.elements - 1)];
    if (scene_.starts_static) {
      const double way = (network_.position[last.node[1]] - network_.position[first.node[0]]).norm();
      const bool is_between = is_held_[first.node[0]] && is_held_[last.node[1]];
      if (!is_between || way <= (1 + much) * unstretched_length(span)) return {};
    }
    Stretched found;
    for (int i = 0; i < span.elements; ++i) {
      const Element& element = network_.elements[at(span.first_element + i)];
      const double strain = drawn(element) / element.length - 1;
      if (strain > found.strain) found = {strain, i};
    }
    return found;
  }

  double drawn_length(const Span& span) const {
    double sum = 0;
    for (int i = 0; i < span.elements; ++i) sum += drawn(network_.elements[at(span.first_element + i)]);
    return sum;
  }

  double unstretched_length(const Span& span) const {
    double sum = 0;
    for (int i = 0; i < span.elements; ++i) sum += network_.elements[at(span.first_element + i)].length;
    return sum;
  }

  const scene::Scene& scene_;
  const Network& network_;
  Table<SceneNode, bool> is_held_;
};

}   // namespace

std::vector<std::string> drawn_notes(const scene::Scene& scene, const Network& network) {
  const DrawnNotes notes(scene, network);
  std::vector<std::string> found;
  for (std::string note : {notes.of_bed(), notes.of_held(), notes.of_spots(), notes.of_stretch()})
    if (!note.empty()) found.push_back(std::move(note));
  return found;
}

}   // namespace cablenet::network
