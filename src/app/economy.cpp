#include "cablenet/app/economy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cablenet/app/run_notes.hpp"
#include "cablenet/network/economy.hpp"

namespace cablenet::app {
namespace {

using network::first_of;
using output::CableShape;

/// The accuracy that is meant.
constexpr double wanted = 0.01;

/// A cable is straight whose nodes stay this near to the line, as parts of its length and of its motion, and one
/// element has one tension: the ends of the cable differ by less than `even`.
constexpr double straight_of_length = 1e-3, straight_of_motion = 0.01, even = 0.01;

/// Motion that is a smaller part of the cable's length than this counts as that part.
constexpr double least_motion = 1e-3;

/// By bends the number of elements is known to a factor of two.  So what would do has a margin, and it is told only
/// where a cable has more than twice that; what is too coarse is told where a cable has less than half.
constexpr double margin = 1.5, factor = 2;
/// Fewer than these do not resolve how loads vary along a cable.
constexpr int fewest = 10;
/// The difference of strains between neighbours may vary by so much of the strain with the fewer elements.
constexpr double most_wobble = 0.05;
/// A cable is under water whose highest node is higher by no more than this part of its length.
constexpr double out_of_water = 0.05;

/// A body that turns less is a point mass.  [rad]
constexpr double least_turn = 0.1 * std::numbers::pi / 180;

/// Steps have to do that are so many times as long before it is told, and these are as much shorter than those for 1 %.
constexpr double steps_factor = 4, steps_margin = 4;

class Economist {
public:
  Economist(const scene::Scene& scene, const network::Network& network, const output::ShapeSummary& shapes)
      : scene_(scene), network_(network), shapes_(shapes) {}

  Economy economy(const std::optional<solve::StepFindings>& steps, double lost) {
    for (std::size_t i = 0; i < scene_.cables.size(); ++i) judge(i);
    say_straight();
    say_fewer();
    say_more();
    say_bodies();
    say_surroundings();
    if (steps) say_steps(*steps, lost);
    return found_;
  }

private:
  int elements(std::size_t cable) const { return network_.spans[cable].elements; }
  /// Unstretched.  [m]
  double length(std::size_t cable) const {
    double sum = 0;
    for (int i = 0; i < elements(cable); ++i)
      sum += network_.elements[at(network_.spans[cable].first_element + i)].length;
    return sum;
  }
  bool is_dry() const {
    const auto& fluid = scene_.fluid;
    return !fluid || (fluid->surface && shapes_.lowest > *fluid->surface + fluid->reach());
  }
  int taps(std::size_t cable) const { return elements(cable) - 1 - static_cast<int>(shapes_.cables[cable].nodes); }

  void judge(std::size_t cable);
  bool is_straight(std::size_t cable) const;
  bool forgets_errors(std::size_t cable) const;
  double elements_for(std::size_t cable, double share) const;

  void say(const std::string& sentence) {
    if (!sentence.empty()) found_.sentences.push_back(sentence);
  }
  double height_above_bed() const;

  void say_straight();
  void say_fewer();
  void say_more();
  void say_bodies();
  void say_surroundings();
  void say_steps(const solve::StepFindings& steps, double lost);

  const scene::Scene& scene_;
  const network::Network& network_;
  const output::ShapeSummary& shapes_;
  Economy found_;
  std::vector<std::string> straight_, fewer_, more_;
  double furthest_ = 0;   ///< of a straight cable's nodes from the line [m]
};

void Economist::judge(std::size_t cable) {
  const int has = elements(cable);
  if (has < 2) return;
  const std::string& name = scene_.cables[cable].name;
  if (is_straight(cable)) {
    straight_.push_back(fmt::format("{} ({})", name, has));
    furthest_ = std::max(furthest_, shapes_.cables[cable].deviation);
    found_.elements.emplace_back(name, 1);
    return;
  }
  const int least = std::max(fewest, 2 * (taps(cable) + 1));
  const double needs = elements_for(cable, wanted);
  const int would_do = std::max(least, static_cast<int>(std::ceil(margin * needs)));
  const double wobble = shapes_.cables[cable].wobble * has / would_do;
  if (has > factor * would_do && forgets_errors(cable) && wobble <= most_wobble * shapes_.cables[cable].strain) {
    fewer_.push_back(fmt::format("{} {} (has {})", name, would_do, has));
    found_.elements.emplace_back(name, would_do);
  } else if (factor * has < needs) {
    more_.push_back(fmt::format("{} {:.0f} (has {})", name, needs, has));
    found_.elements.emplace_back(name, static_cast<int>(std::lround(needs)));
  }
}

bool Economist::is_straight(std::size_t cable) const {
  const CableShape& shape = shapes_.cables[cable];
  const double size = length(cable), motion = std::max(shape.motion, least_motion * size);
  return taps(cable) == 0 && shape.deviation <= straight_of_length * size &&
         shape.deviation <= straight_of_motion * motion && shape.jump * elements(cable) <= even * shape.strain;
}

/// In vacuum, vibration along a cable lasts, and its error grows whatever the bends; where a cable lies down, the place
/// where it does is known to an element.
bool Economist::forgets_errors(std::size_t cable) const {
  const CableShape& shape = shapes_.cables[cable];
  const double size = length(cable);
  if (scene_.bed && shape.lowest <= scene_.bed->level + size / elements(cable)) return false;
  if (scene_.is_static) return true;
  if (!scene_.fluid || scene_.cable_types[at(scene_.cables[cable].type)].normal_drag == 0) return false;
  return !scene_.fluid->surface ||
         shape.highest <= *scene_.fluid->surface + scene_.fluid->reach() + out_of_water * size;
}

/// The arc through three nodes lies off its chords by the sag s, which goes with the square of an element's length.
/// What varies of it errs by that part of the motion, and s by that part of half the length.  Measured:
/// src/numerics.md.
double Economist::elements_for(std::size_t cable, double share) const {
  const CableShape& shape = shapes_.cables[cable];
  const double size = length(cable), motion = std::max(shape.motion, least_motion * size);
  return elements(cable) * std::sqrt((shape.bending / motion + 2 * shape.sag / size) / share);
}

void Economist::say_straight() {
  if (straight_.empty()) return;
  say(fmt::format(
      "elements: 1 would do for {}, whose nodes stayed within {:.1g} m of the line between the ends, with one "
      "tension",
      first_of(straight_), furthest_));
}

void Economist::say_fewer() {
  if (fewer_.empty()) return;
  say(fmt::format("elements that 1 % needs by the cables' bends: {}", first_of(fewer_)));
}

void Economist::say_more() {
  if (more_.empty()) return;
  say(fmt::format("too few elements for 1 % by the cables' bends, which want about: {}", first_of(more_)));
}

void Economist::say_bodies() {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < network_.bodies.size(); ++i)
    if (network_.bodies[i].properties.rotation != bodies::Rotation::none && shapes_.turned[i] < least_turn)
      names.push_back(network_.bodies[i].name);
  if (names.empty()) return;
  say(
      fmt::format("no inertia would do for {}, which never turned by more than 0.1 degrees: a point mass has three "
                  "unknowns",
                  first_of(names)));
}

void Economist::say_surroundings() {
  if (scene_.fluid && scene_.fluid->surface) {
    say(network::faint_waves(scene_, shapes_.highest,
                             fmt::format("at the highest node, z = {:.3g} m", shapes_.highest)));
    if (is_dry())
      say(fmt::format("no environment.fluid would do: no node came lower than {:.3g} m above the surface",
                      shapes_.lowest - *scene_.fluid->surface));
  }
  if (scene_.bed && height_above_bed() > 0)
    say(fmt::format("no environment.seabed would do: nothing came nearer to it than {:.3g} m", height_above_bed()));
}

/// Of the lowest node, or less by the largest radius that may touch the bed there.  [m]
double Economist::height_above_bed() const {
  double radius = 0;
  for (const auto& spot : network_.bed_spots) radius = std::max(radius, spot.radius);
  for (const auto& cable : network_.surroundings.on_bed) radius = std::max(radius, cable.diameter);
  return shapes_.lowest - scene_.bed->level - radius;
}

/// Where errors add up, or cables hit the bed, tensions may want shorter steps than the motion does.
void Economist::say_steps(const solve::StepFindings& steps, double lost) {
  if (steps.is_adaptive || steps.adds_up() || is_dry() || (scene_.bed && height_above_bed() <= 0)) return;
  const double interval = scene_.output.interval;
  double good = step_for_accuracy(steps, lost) / steps_margin;
  if (interval > 0) good = std::min(good, interval);
  if (good < steps_factor * steps.step) return;
  say(fmt::format("steps of {:.1g} s would do for 1 %: those of {:.2g} s err by less than {} %", good, steps.step,
                  steps.share() < 1e-4 ? "0.01" : "0.1"));
}

}   // namespace

Economy economy_of(const scene::Scene& scene, const network::Network& network, const output::ShapeSummary& shapes,
                   const std::optional<solve::StepFindings>& steps, double lost) {
  return Economist(scene, network, shapes).economy(steps, lost);
}

}   // namespace cablenet::app
