#include "choices.hpp"

#include <fmt/format.h>
#include <petscts.h>

#include "cablenet/base/errors.hpp"
#include "cablenet/petsc/handle.hpp"

namespace cablenet::app {
namespace {

using petsc::check;

std::string text_option(const char* name) {
  char value[64] = "";
  PetscBool found = PETSC_FALSE;
  check(PetscOptionsGetString(nullptr, nullptr, name, value, sizeof(value), &found));
  return value;
}

}   // namespace

scene::Time chosen_time(scene::Time time) {
  PetscBool given = PETSC_FALSE;
  check(PetscOptionsGetReal(nullptr, nullptr, "-ts_alpha_radius", &time.spectral_radius, &given));
  if (given && !(time.spectral_radius >= 0 && time.spectral_radius <= 1))
    throw InputError(
        fmt::format("-ts_alpha_radius: {} is not allowed; expected a number from 0 to 1", time.spectral_radius));
  if (given && time.scheme == scene::Scheme::energy_momentum) time.scheme = scene::Scheme::generalized_alpha;
  const std::string type = text_option("-ts_type");
  if (!type.empty() && type != TSALPHA2)
    throw InputError(fmt::format("-ts_type: `{}` is not allowed; every scheme here runs in PETSc's alpha2", type));
  return time;
}

system::ForceRule force_rule(const scene::Time& time) {
  system::ForceRule rule{time.scheme, time.axial_dissipation, elements::Tangent::exact};
  const std::string tangent = text_option("-cable_tangent");
  if (!tangent.empty() && tangent != "exact" && tangent != "secant")
    throw InputError(fmt::format("-cable_tangent: `{}` is not allowed; expected exact or secant", tangent));
  if (tangent == "secant") rule.tangent = elements::Tangent::secant;
  PetscBool given = PETSC_FALSE;
  if (time.scheme != scene::Scheme::energy_momentum) return rule;
  check(PetscOptionsGetReal(nullptr, nullptr, "-cable_axial_dissipation", &rule.axial_dissipation, &given));
  if (!(rule.axial_dissipation >= 0 && rule.axial_dissipation <= 0.5))
    throw InputError(fmt::format("-cable_axial_dissipation: {} is not allowed; expected a number from 0 to 0.5",
                                 rule.axial_dissipation));
  return rule;
}

std::string scheme_name(const scene::Time& time, const system::ForceRule& rule) {
  const std::string name = scene::name_of(time.scheme);
  if (time.scheme == scene::Scheme::energy_momentum)
    return fmt::format("{}, axial dissipation {}", name, rule.axial_dissipation);
  return fmt::format("{}, spectral radius {}", name, time.spectral_radius);
}

}   // namespace cablenet::app
