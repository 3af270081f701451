#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "parts.hpp"

#include "cablenet/environment/water.hpp"

namespace cablenet::scene {

namespace {

using environment::Bed;
using environment::CurrentLayer;
using environment::Fluid;
using environment::Wave;

double number_or(const Section& section, const char* key, Sign sign, const char* unit, double otherwise) {
  const Value* value = section.find(key);
  return value != nullptr ? read_number(*value, sign, unit) : otherwise;
}

double positive(const Section& section, const char* key, const char* unit) {
  return read_number(section.require(key, fmt::format("a number > 0 [{}]", unit)), Sign::positive, unit);
}

/// A row out of order is more likely a lost minus than a matter of taste.
std::vector<CurrentLayer> read_profile(const Value& value) {
  const std::string expected = "a list of at least one row [z, u, v, w] [m, m/s, m/s, m/s]";
  const std::vector<Value> rows = read_list(value, expected);
  if (rows.empty()) value.refuse(expected, "Add rows, or remove current: the water then stands still.");
  std::vector<CurrentLayer> layers;
  for (const Value& row : rows) {
    const std::vector<double> n = read_numbers(row, 4, "[z, u, v, w], four numbers [m, m/s, m/s, m/s]");
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

std::vector<CurrentLayer> read_current(const Value& value) {
  const std::string expected = "{velocity: [u, v, w]} [m/s] or {profile: [[z, u, v, w], ...]}";
  if (!value.node.IsMap()) value.refuse(expected, "Write one of these.");
  const Section section(value, {"velocity", "profile"});
  if (value.node.size() != 1) value.refuse(expected + ", exactly one of them", "Keep one.");
  if (const Value* profile = section.find("profile")) return read_profile(*profile);
  return {{0, read_vector(*section.find("velocity"), "m/s")}};
}

Wave read_wave(const Value& value, double depth, double gravity) {
  const Section section(value, {"height", "period", "direction", "phase"});
  Wave wave;
  wave.amplitude =
      read_number(section.require("height", "a number >= 0 [m], from trough to crest"), Sign::not_negative, "m") / 2;
  wave.frequency = 2 * std::numbers::pi / positive(section, "period", "s");
  const bool is_ordinary = std::isnormal(wave.frequency * wave.frequency);
  wave.number = is_ordinary ? environment::wave_number(wave.frequency, depth, gravity) : 0;
  if (!std::isfinite(wave.number) || !(wave.number > 0))
    section.find("period")->refuse("one of a wave whose length is a finite number > 0 [s]", "Correct the value.");
  const Value* direction = section.find("direction");
  const double angle = direction != nullptr ? read_angle(*direction) : 0;
  wave.direction = {std::cos(angle), std::sin(angle)};
  const Value* phase = section.find("phase");
  wave.phase = phase != nullptr ? read_angle(*phase) : 0;
  return wave;
}

/// @pre surface and depth are read where they are given.
std::vector<Wave> read_waves(const Value& value, const Section& section, double depth, double gravity) {
  std::vector<Wave> waves;
  const std::vector<Value> items = read_list(value, "a list of waves {height, period, direction, phase}");
  if (items.empty()) return waves;
  section.require("surface", "a number [m], the z of the still water, as waves need it");
  section.require("depth", "a number > 0 [m], of the water, as waves need it");
  if (!(gravity > 0))
    value.fail("waves are not allowed with environment.gravity: 0; expected a gravity that drives them. Remove one.");
  for (const Value& item : items) waves.push_back(read_wave(item, depth, gravity));
  return waves;
}

Fluid read_fluid(const Value& value, double gravity) {
  const Section section(value, {"density", "surface", "current", "waves", "depth"});
  Fluid fluid;
  fluid.density = positive(section, "density", "kg/m3");
  if (const Value* surface = section.find("surface")) fluid.surface = read_number(*surface, Sign::any, "m");
  fluid.depth = number_or(section, "depth", Sign::positive, "m", 0);
  if (const Value* current = section.find("current")) fluid.current = read_current(*current);
  if (const Value* waves = section.find("waves")) fluid.waves = read_waves(*waves, section, fluid.depth, gravity);
  return fluid;
}

Bed read_bed(const Value& value, const std::optional<Fluid>& fluid) {
  const Section section(value, {"level", "stiffness", "damping", "friction", "friction_velocity"});
  Bed bed;
  const Value& level = section.require("level", "a number [m], the z of the bed");
  bed.level = read_number(level, Sign::any, "m");
  if (fluid && fluid->surface && !(bed.level < *fluid->surface))
    level.refuse(fmt::format("a bed below environment.fluid.surface, which is {} [m]", *fluid->surface),
                 "z is up: correct level or surface.");
  bed.stiffness = positive(section, "stiffness", "Pa/m");
  bed.damping = number_or(section, "damping", Sign::not_negative, "Pa s/m", bed.damping);
  bed.friction = number_or(section, "friction", Sign::not_negative, "", bed.friction);
  bed.friction_velocity = number_or(section, "friction_velocity", Sign::positive, "m/s", bed.friction_velocity);
  return bed;
}

}   // namespace

void read_environment(const Section& top, Scene& scene) {
  const Value* value = top.find("environment");
  if (value == nullptr) return;
  const Section section(*value, {"gravity", "fluid", "seabed"});
  scene.gravity = number_or(section, "gravity", Sign::not_negative, "m/s2", scene.gravity);
  if (const Value* fluid = section.find("fluid")) scene.fluid = read_fluid(*fluid, scene.gravity);
  if (const Value* seabed = section.find("seabed")) scene.bed = read_bed(*seabed, scene.fluid);
}

}   // namespace cablenet::scene
