#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "parts.hpp"

namespace cablenet::scene {

namespace {

/// With one of the two given the other is that of a circle.
void read_cross_section(const Section& section, const Scene& scene, CableType& type) {
  const Value* diameter = section.find("diameter");
  const Value* area = section.find("area");
  if (diameter != nullptr) type.diameter = read_number(*diameter, Sign::positive, "m");
  type.area =
      area != nullptr ? read_number(*area, Sign::positive, "m2") : std::numbers::pi * type.diameter * type.diameter / 4;
  if (diameter == nullptr) type.diameter = std::sqrt(4 * type.area / std::numbers::pi);
  if (diameter != nullptr || area != nullptr || (!scene.fluid && !scene.bed)) return;
  section.map().fail(fmt::format("diameter is missing: {} needs it; expected diameter [m] or area [m2], > 0. Add one.",
                                 scene.fluid ? "environment.fluid" : "environment.seabed"));
}

struct PerArea {
  const char* key;
  const char* unit;
};

/// A property of the cross-section: `whole` as given, or `part` times the area.
double read_whole(const Section& section, PerArea part, PerArea whole, double area) {
  const Value* part_value = section.find(part.key);
  const Value* whole_value = section.find(whole.key);
  if (part_value != nullptr && whole_value != nullptr)
    whole_value->fail(fmt::format("contradicts {}; expected one of the two. Remove one.", part.key));
  if (whole_value != nullptr) return read_number(*whole_value, Sign::positive, whole.unit);
  if (part_value == nullptr)
    section.map().fail(fmt::format("{} is missing; expected {} [{}] or {} [{}], > 0. Add one of them.", part.key,
                                   part.key, part.unit, whole.key, whole.unit));
  const double value = read_number(*part_value, Sign::positive, part.unit);
  if (area == 0)
    section.map().fail(
        fmt::format("area is missing: {} needs it. Add area [m2] or diameter [m], or give {} [{}] "
                    "instead.",
                    part.key, whole.key, whole.unit));
  return value * area;
}

void read_water(const Section& section, CableType& type) {
  const std::pair<const char*, double&> coefficients[] = {
      {"normal_drag", type.normal_drag}, {"tangential_drag", type.tangential_drag}, {"added_mass", type.added_mass}};
  for (const auto& [key, coefficient] : coefficients)
    if (const Value* value = section.find(key)) coefficient = read_number(*value, Sign::not_negative, "");
}

CableType read_type(const Named& named, const Scene& scene) {
  const Section section(named.value,
                        {"area", "diameter", "density", "mass_per_length", "youngs_modulus", "axial_stiffness",
                         "tension_only", "axial_damping", "rayleigh", "normal_drag", "tangential_drag", "added_mass"});
  CableType type;
  type.name = named.name;
  read_cross_section(section, scene, type);
  type.mass_per_length = read_whole(section, {"density", "kg/m3"}, {"mass_per_length", "kg/m"}, type.area);
  type.axial_stiffness = read_whole(section, {"youngs_modulus", "Pa"}, {"axial_stiffness", "N"}, type.area);
  read_water(section, type);
  if (const Value* value = section.find("tension_only")) type.tension_only = read_boolean(*value);
  if (const Value* value = section.find("axial_damping"))
    type.axial_damping = read_number(*value, Sign::not_negative, "N s");
  if (const Value* value = section.find("rayleigh")) {
    const Section rayleigh(*value, {"mass", "stiffness"});
    if (const Value* mass = rayleigh.find("mass")) type.rayleigh_mass = read_number(*mass, Sign::not_negative, "1/s");
    if (const Value* stiffness = rayleigh.find("stiffness"))
      type.rayleigh_stiffness = read_number(*stiffness, Sign::not_negative, "s");
  }
  return type;
}

}   // namespace

std::vector<CableType> read_cable_types(const Section& top, const Scene& scene, Names& names) {
  const std::string expected = "a map from names to cable types";
  std::vector<CableType> types;
  const bool is_needed = top.find("cables") != nullptr || top.find("nets") != nullptr;
  if (!is_needed && top.find("cable_types") == nullptr) return types;
  for (const Named& named : read_named(top.require("cable_types", expected), expected)) {
    names.add(named.name, static_cast<int>(types.size()), 0);
    types.push_back(read_type(named, scene));
  }
  return types;
}

}   // namespace cablenet::scene
