#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "parts.hpp"
#include "rows.hpp"

#include "cablenet/environment/water.hpp"

namespace cablenet::scene {

namespace {

using environment::Bed;
using environment::CurrentLayer;
using environment::Fluid;
using environment::Wave;

const std::string layer_labels = "[z, u, v, w], four numbers [m, m/s, m/s, m/s]";
const std::string profile_expected = "a list of at least one row [z, u, v, w] [m, m/s, m/s, m/s]";

/// A row out of order is more likely a lost minus than a matter of taste.
std::vector<CurrentLayer> read_profile(const Value& value) {
  const std::vector<Value> rows = read_list(value, profile_expected);
  if (rows.empty()) value.refuse(profile_expected, "Add rows, or remove current: the water then stands still.");
  std::vector<CurrentLayer> layers;
  for (const Value& row : rows) {
    const std::vector<double> n = read_numbers(row, 4, layer_labels);
    const bool has_order = layers.size() > 1;
    const bool rises = has_order && layers[1].z > layers[0].z;
    if (!layers.empty() && n[0] == layers.back().z)
      row.fail(fmt::format("z = {} is not allowed; expected another than that of the row before. Keep one of the two.",
                           n[0]));
    if (has_order && (n[0] > layers.back().z) != rises)
      row.fail(fmt::format("z = {} is not allowed; expected one {} {}, as the rows before go {}. Sort the rows by z.",
                           n[0], rises ? ">" : "<", layers.back().z, rises ? "up" : "down"));
    layers.push_back({n[0], Vector3(n[1], n[2], n[3])});
  }
  if (layers.front().z > layers.back().z) return {layers.rbegin(), layers.rend()};
  return layers;
}

Kind<std::vector<CurrentLayer>> profile() {
  const NumberForm height{"m", any_number}, speed{"m/s", any_number};
  return {list_form(profile_expected, tuple_form(layer_labels, {height, speed, speed, speed}), 1), read_profile,
          nullptr};
}

using Layers = std::vector<CurrentLayer>;
const Table<Layers> current_table(
    "The velocity of the water without waves.",
    {{"velocity", vector("m/s"), absent(""), "The water has this velocity everywhere.",
      [](Layers& layers, const Vector3& velocity) {
        layers = {{0, velocity}};
      }},
     {"profile", profile(), absent(""),
      "Rows of height z and velocity (u, v, w); the velocity is linear between rows and constant beyond them.",
      [](Layers& layers, const Layers& rows) { layers = rows; }}},
    Holds::one_key, "{velocity: [u, v, w]} [m/s] or {profile: [[z, u, v, w], ...]}");

struct WaveKeys {
  double height = 0, period = 0, direction = 0, phase = 0;
};
const Table<WaveKeys> wave_table(
    "A linear (Airy) wave; its elevation is height/2 cos(k s - 2 pi t/period + phase), s along its direction.",
    {{"height", number("m", at_least(0)), required, "The height from trough to crest.", &WaveKeys::height},
     {"period", number("s", above(0)), required, "The period.", &WaveKeys::period},
     {"direction", angle(), standard, "Where the wave runs to, turned from +x towards +y.", &WaveKeys::direction},
     {"phase", angle(), standard, "The phase at the origin at t = 0.", &WaveKeys::phase}});

/// Whether there may be waves depends on other keys.
struct FluidKeys : Fluid {
  std::optional<Value> given_waves;
};
const Table<FluidKeys> fluid_table(
    "The water.",
    {{"density", number("kg/m3", above(0)), required, "The density of the water.", &FluidKeys::density},
     {"surface", number("m"), absent("water is everywhere"), "The z of the still water's surface.",
      &FluidKeys::surface},
     {"current", section(current_table), absent("the water stands still"), "The water's velocity without waves.",
      &FluidKeys::current},
     {"waves", later(list_form("a list of waves {height, period, direction, phase}", section_form(wave_table))),
      absent("there are none"), "Waves, which add up; they need surface and depth.", &FluidKeys::given_waves},
     {"depth", number("m", above(0)), absent("allowed without waves only"), "The depth of the water below its surface.",
      &FluidKeys::depth}});

const Table<Bed> seabed_table(
    "A flat seabed that cables may touch.",
    {{"level", number("m"), required, "The z of the bed.", &Bed::level},
     {"stiffness", number("Pa/m", above(0)), required, "The pressure of the bed per depth of what sinks into it.",
      &Bed::stiffness},
     {"damping", number("Pa s/m", at_least(0)), standard, "The pressure of the bed per speed of what sinks into it.",
      &Bed::damping},
     {"friction", number("", at_least(0)), standard,
      "Coulomb's coefficient of friction. What lies still is held by springs, up to this times the bed's pressure.",
      &Bed::friction},
     {"friction_stiffness", number("Pa/m", above(0)),
      absent("what lies at rest travels by `friction` times 0.7 % of its diameter before it slips, and by `friction` "
             "times what it lies deeper than a quarter of its diameter"),
      "The pressure of friction per travel of what sticks to the bed.", &Bed::friction_stiffness},
     {"friction_velocity", number("m/s", above(0)), absent("friction holds what lies still"),
      "Makes friction viscous: it holds nothing still, and at this speed it has reached 1/sqrt(2) of Coulomb's.",
      &Bed::friction_velocity}});

/// The bed and the waves depend on other keys.
struct EnvironmentKeys {
  double gravity = Scene{}.gravity;
  std::optional<Value> fluid, seabed;
};
const Table<EnvironmentKeys> environment_table(
    "What surrounds the cables.",
    {{"gravity", number("m/s2", at_least(0)), standard, "The acceleration of gravity, which acts along -z.",
      &EnvironmentKeys::gravity},
     {"fluid", later(section_form(fluid_table)), absent("a vacuum; nothing of water is computed"), "The water.",
      &EnvironmentKeys::fluid},
     {"seabed", later(section_form(seabed_table)), absent("there is none"), "A flat seabed.",
      &EnvironmentKeys::seabed}});

Wave read_wave(const Value& value, double depth, double gravity) {
  WaveKeys keys;
  const Section section = read_rows(value, wave_table, keys);
  Wave wave;
  wave.amplitude = keys.height / 2;
  wave.frequency = 2 * std::numbers::pi / keys.period;
  const bool is_ordinary = std::isnormal(wave.frequency * wave.frequency);
  wave.number = is_ordinary ? environment::wave_number(wave.frequency, depth, gravity) : 0;
  if (!std::isfinite(wave.number) || !(wave.number > 0))
    section.find("period")->refuse("one of a wave whose length is a finite number > 0 [s]", "Correct the value.");
  wave.direction = {std::cos(keys.direction), std::sin(keys.direction)};
  wave.phase = keys.phase;
  return wave;
}

std::vector<Wave> read_waves(const Value& value, const Section& section, double depth, double gravity) {
  std::vector<Wave> waves;
  const std::vector<Value> items = read_list(value, "a list of waves {height, period, direction, phase}");
  if (items.empty()) return waves;
  section.require("surface", ", as waves need it");
  section.require("depth", ", as waves need it");
  if (!(gravity > 0))
    value.fail("waves are not allowed with environment.gravity: 0; expected a gravity that drives them. Remove one.");
  for (const Value& item : items) waves.push_back(read_wave(item, depth, gravity));
  return waves;
}

Fluid read_fluid(const Value& value, double gravity) {
  FluidKeys keys;
  const Section section = read_rows(value, fluid_table, keys);
  if (keys.given_waves) keys.waves = read_waves(*keys.given_waves, section, keys.depth, gravity);
  return keys;
}

Bed read_bed(const Value& value, const std::optional<Fluid>& fluid) {
  Bed bed;
  const Section section = read_rows(value, seabed_table, bed);
  if (bed.friction_stiffness > 0 && bed.friction_velocity > 0)
    section.find("friction_stiffness")
        ->fail("is not allowed beside friction_velocity, whose friction has no springs. Remove one of the two.");
  if (fluid && fluid->surface && !(bed.level < *fluid->surface))
    section.find("level")->refuse(
        fmt::format("a bed below environment.fluid.surface, which is {} [m]", *fluid->surface),
        "z is up: correct level or surface.");
  return bed;
}

}   // namespace

Form environment_form() { return section_form(environment_table); }

void read_environment(const Value& value, Scene& scene) {
  EnvironmentKeys keys;
  read_rows(value, environment_table, keys);
  scene.gravity = keys.gravity;
  if (keys.fluid) scene.fluid = read_fluid(*keys.fluid, scene.gravity);
  if (keys.seabed) scene.bed = read_bed(*keys.seabed, scene.fluid);
}

}   // namespace cablenet::scene
