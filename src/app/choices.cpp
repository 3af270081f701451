#include "choices.hpp"

#include <fmt/format.h>
#include <petscts.h>

#include "cablenet/base/errors.hpp"
#include "cablenet/petsc/handle.hpp"
#include "cablenet/solve/own_options.hpp"
#include "cablenet/solve/scheme.hpp"

namespace cablenet::app {
namespace {

using petsc::check;

constexpr double most_dissipation = 0.5;

void refuse_other_steppers() {
  char type[64] = "";
  check(PetscOptionsGetString(nullptr, nullptr, "-ts_type", type, sizeof(type), nullptr));
  if (*type != '\0' && std::string(type) != TSALPHA2)
    throw InputError(fmt::format("-ts_type: `{}` is not allowed; every scheme here runs in PETSc's alpha2", type));
}

}   // namespace

scene::Time chosen_time(scene::Time time) {
  PetscBool given = PETSC_FALSE;
  PetscReal radius = time.spectral_radius;
  check(PetscOptionsGetReal(nullptr, nullptr, "-ts_alpha_radius", &radius, &given));
  if (given && !(radius >= 0 && radius <= 1))
    throw InputError(fmt::format("-ts_alpha_radius: {} is not allowed; expected a number from 0 to 1", radius));
  if (given) time.spectral_radius = radius;
  refuse_other_steppers();
  return time;
}

system::ForceRule chosen_force_rule(const scene::Time& time) {
  const auto& tangent_option = solve::tangent_option;
  system::ForceRule rule = solve::force_rule_of(time);
  const std::string tangent =
      petsc::text_option(PETSC_COMM_WORLD, nullptr, tangent_option.text, tangent_option.fallback);
  if (tangent != "exact" && tangent != "secant")
    throw InputError(fmt::format("{}: `{}` is not allowed; expected {}", tangent_option.text.name, tangent,
                                 tangent_option.expected));
  if (tangent == "secant") rule.tangent = elements::Tangent::secant;
  if (solve::row_of(time.scheme).has_axial_dissipation)
    rule.axial_dissipation = solve::read_number(solve::axial_dissipation_option, PETSC_COMM_WORLD, nullptr,
                                                rule.axial_dissipation, 0, most_dissipation);
  return rule;
}

}   // namespace cablenet::app
