#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "parts.hpp"

namespace cablenet::scene {

namespace {

bool turns(const std::array<double, 6>& numbers) {
  return std::any_of(numbers.begin() + 3, numbers.end(), [](double number) { return number != 0; });
}

/// Whether a value holds a number other than zero.
bool acts(const YAML::Node& node) {
  if (node.IsScalar()) return node.as<double>(0) != 0;
  return std::any_of(node.begin(), node.end(),
                     [&](const auto& part) { return acts(node.IsMap() ? part.second : part); });
}

/// The keys of the sections in a map from names.
const std::vector<Key>& keys_in(const Form& map) {
  return std::get<SectionForm>(std::get<MapForm>(map.details).item[0].details).table->keys;
}

/// The value of a key that the map has.
Value value_of(const Value& map, const std::string& key) {
  for (const Named& named : read_named(map, "a map of keys"))
    if (named.name == key) return named.value;
  return map;
}

class WaterNotes {
public:
  WaterNotes(const Section& top, const Scene& scene) : top_(top), scene_(scene) {}

  void add_environment() {
    if (!scene_.fluid || scene_.fluid->waves.empty()) return;
    const Value fluid = value_of(*top_.find("environment"), "fluid");
    add_depth(value_of(fluid, "depth"));
    const std::vector<Value> waves = read_list(value_of(fluid, "waves"), "a list of waves");
    for (std::size_t i = 0; i < waves.size(); ++i) add_steepness(waves[i], scene_.fluid->waves[i]);
  }

  void add_types() {
    if (scene_.cable_types.empty()) return;
    const std::vector<Named> types = read_named(*top_.find("cable_types"), "a map of cable types");
    for (const Named& type : types) add_idle(type.value, keys_in(cable_types_form()));
  }

  void add_points(const std::vector<PointDraft>& points) {
    for (const PointDraft& draft : points) add_idle(draft.value, keys_in(points_form()));
  }

  void add_bodies(const std::vector<BodyDraft>& bodies) {
    for (const BodyDraft& draft : bodies) {
      add_idle(draft.value, keys_in(bodies_form()));
      if (!draft.thing.inertia && draft.thing.contact && scene_.bed)
        add(value_of(draft.value, "contact"), "does nothing: a body without inertia is a sphere of its volume");
      if (!scene_.fluid && scene_.bed && draft.thing.inertia && draft.thing.volume > 0)
        add(value_of(draft.value, "volume"),
            "does nothing without environment.fluid: the box of the inertia lies on the bed");
      if (!scene_.fluid) continue;
      if (!draft.thing.inertia)
        add_point_mass(draft.value, draft.thing);
      else if (draft.thing.volume == 0 && !draft.thing.center_of_buoyancy.isZero(0))
        add(value_of(draft.value, "center_of_buoyancy"), "does nothing without volume");
    }
  }

  std::vector<std::string> taken() { return std::move(notes_); }

private:
  void add(const Value& value, const std::string& text) { notes_.push_back(value.said(text)); }

  bool is_absent(const std::string& section) const {
    if (section.empty()) return false;
    const bool has_fluid = scene_.fluid && section.find("environment.fluid") != std::string::npos;
    return !has_fluid && !(scene_.bed && section.find("environment.seabed") != std::string::npos);
  }

  /// Keys that need a section which is not there.
  void add_idle(const Value& map, const std::vector<Key>& keys) {
    for (const Named& given : read_named(map, "a map of keys"))
      for (const Key& key : keys)
        if (key.name == given.name && is_absent(key.needs) && acts(given.value.node))
          add(given.value, "does nothing without " + key.needs);
  }

  void add_point_mass(const Value& map, const Body& body) {
    const char* about = "its last three numbers do nothing: a body without inertia does not turn";
    if (!body.center_of_buoyancy.isZero(0))
      add(value_of(map, "center_of_buoyancy"), "does nothing: a body without inertia does not turn");
    if (turns(body.linear_drag)) add(value_of(value_of(map, "drag"), "linear"), about);
    if (turns(body.quadratic_drag)) add(value_of(value_of(map, "drag"), "quadratic"), about);
    if (turns(body.added_mass)) add(value_of(map, "added_mass"), about);
  }

  void add_depth(const Value& depth) {
    if (!scene_.bed) return;
    const double bottom = *scene_.fluid->surface - scene_.fluid->depth;
    if (std::abs(bottom - scene_.bed->level) <= 0.01 * scene_.fluid->depth) return;
    add(depth, fmt::format("the waves run over a bed at surface - depth = {} m, cables lie on one at "
                           "environment.seabed.level, {} m",
                           bottom, scene_.bed->level));
  }

  /// Where waves break, after Miche (1944); in deep water at a seventh of their length.
  void add_steepness(const Value& value, const environment::Wave& wave) {
    const double steepness = wave.amplitude * wave.number / std::numbers::pi;
    const double breaking = 0.142 * std::tanh(wave.number * scene_.fluid->depth);
    if (steepness <= breaking) return;
    add(value, fmt::format("its height is {:.3g} of its length and such waves break at {:.3g}: outside the range of "
                           "linear theory",
                           steepness, breaking));
  }

  const Section& top_;
  const Scene& scene_;
  std::vector<std::string> notes_;
};

}   // namespace

std::vector<std::string> water_notes(const Section& top, const std::vector<PointDraft>& points,
                                     const std::vector<BodyDraft>& bodies, const Scene& scene) {
  WaterNotes notes(top, scene);
  notes.add_environment();
  notes.add_types();
  notes.add_points(points);
  notes.add_bodies(bodies);
  return notes.taken();
}

}   // namespace cablenet::scene
