#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "parts.hpp"
#include "rows.hpp"

namespace cablenet::scene {

namespace {

const Table<CableType> rayleigh_table(
    "Rayleigh's damping: mass times the mass matrix plus stiffness times the stiffness matrix.",
    {{"mass", number("1/s", at_least(0)), standard, "The factor of the mass matrix.", &CableType::rayleigh_mass},
     {"stiffness", number("s", at_least(0)), standard, "The factor of the stiffness matrix.",
      &CableType::rayleigh_stiffness}});

/// A property of the cross-section may be given as a whole or per area.
struct TypeKeys : CableType {
  std::optional<double> given_area, given_diameter, density, youngs_modulus, given_mass, given_stiffness;
};
const std::string from_density = "density times area", from_modulus = "youngs_modulus times area";
const Table<TypeKeys> type_table(
    "What a cable is made of.",
    {{"area", number("m2", above(0)), absent("that of a circle of the diameter"),
      "The cross-section, for mass, stiffness and buoyancy.", &TypeKeys::given_area},
     {"diameter", number("m", above(0)), absent("that of a circle of the area"),
      "The diameter, for drag and for contact with the bed.", &TypeKeys::given_diameter},
     {"density", number("kg/m3", above(0)), absent("mass_per_length is given"),
      "The mass of the unstretched cable per volume.", &TypeKeys::density},
     {"mass_per_length", number("kg/m", above(0)), absent(from_density),
      "The mass of the unstretched cable per length.", &TypeKeys::given_mass},
     {"youngs_modulus", number("Pa", above(0)), absent("axial_stiffness is given"), "Young's modulus.",
      &TypeKeys::youngs_modulus},
     {"axial_stiffness", number("N", above(0)), absent(from_modulus), "The tension per strain, EA.",
      &TypeKeys::given_stiffness},
     {"tension_only", boolean(), standard, "Whether a slack element carries nothing instead of pushing.",
      &TypeKeys::tension_only},
     {"axial_damping", number("N s", at_least(0)), standard, "The tension per strain rate.", &TypeKeys::axial_damping},
     {"rayleigh", later(section_form(rayleigh_table)), absent("there is none"), "Rayleigh's damping.",
      [](CableType& type, const Value& value) { read_rows(value, rayleigh_table, type); }},
     Row<TypeKeys>("normal_drag", number("", at_least(0)), standard,
                   "The drag coefficient across the cable, Cdn: 1/2 rho Cdn d |un| un per length.",
                   &TypeKeys::normal_drag)
         .in_fluid(),
     Row<TypeKeys>("tangential_drag", number("", at_least(0)), standard,
                   "The drag coefficient along the cable, Cdt: 1/2 rho Cdt pi d |ut| ut per length.",
                   &TypeKeys::tangential_drag)
         .in_fluid(),
     Row<TypeKeys>("added_mass", number("", at_least(0)), standard,
                   "The coefficient of added mass across the cable, Ca: rho A Ca per length.", &TypeKeys::added_mass)
         .in_fluid()});

/// With one of the two given the other is that of a circle.
void settle_cross_section(const Section& section, const Scene& scene, TypeKeys& type) {
  if (!type.given_diameter && !type.given_area && (scene.fluid || scene.bed))
    section.map().fail(
        fmt::format("diameter is missing: {} needs it; expected diameter [m] or area [m2], > 0. Add one.",
                    scene.fluid ? "environment.fluid" : "environment.seabed"));
  type.diameter = type.given_diameter.value_or(0);
  type.area = type.given_area.value_or(std::numbers::pi * type.diameter * type.diameter / 4);
  if (!type.given_diameter) type.diameter = std::sqrt(4 * type.area / std::numbers::pi);
}

/// A property of the cross-section as it was given.
struct Given {
  const char* key;
  const char* unit;
  const std::optional<double>& value;
};

/// The property `whole` as given, or `part` times the area.
double settled(const Section& section, const Given& part, const Given& whole, double area) {
  if (part.value && whole.value)
    section.find(whole.key)->fail(fmt::format("contradicts {}; expected one of the two. Remove one.", part.key));
  if (whole.value) return *whole.value;
  if (!part.value)
    section.map().fail(fmt::format("{} is missing; expected {} [{}] or {} [{}], > 0. Add one of them.", part.key,
                                   part.key, part.unit, whole.key, whole.unit));
  if (area == 0)
    section.map().fail(
        fmt::format("area is missing: {} needs it. Add area [m2] or diameter [m], or give {} [{}] "
                    "instead.",
                    part.key, whole.key, whole.unit));
  return *part.value * area;
}

CableType read_type(const Named& named, const Scene& scene) {
  TypeKeys type;
  const Section section = read_rows(named.value, type_table, type);
  type.name = named.name;
  settle_cross_section(section, scene, type);
  type.mass_per_length =
      settled(section, {"density", "kg/m3", type.density}, {"mass_per_length", "kg/m", type.given_mass}, type.area);
  type.axial_stiffness = settled(section, {"youngs_modulus", "Pa", type.youngs_modulus},
                                 {"axial_stiffness", "N", type.given_stiffness}, type.area);
  return type;
}

}   // namespace

Form cable_types_form() { return map_form("a map from names to cable types", section_form(type_table)); }

std::vector<CableType> read_cable_types(const Value& value, const Scene& scene, Names& names) {
  std::vector<CableType> types;
  for (const Named& named : read_named(value, cable_types_form().expected)) {
    names.add(named.name, static_cast<int>(types.size()), 0);
    types.push_back(read_type(named, scene));
  }
  return types;
}

}   // namespace cablenet::scene
