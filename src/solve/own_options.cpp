#include "cablenet/solve/own_options.hpp"

#include <fmt/format.h>

#include <array>

#include "cablenet/base/errors.hpp"

namespace cablenet::solve {

const OwnOption axial_dissipation_option{
    {"-cable_axial_dissipation", "energy_momentum: how much energy it removes from axial vibration"},
    "a number from 0 to 0.5",
    "0.0053; 0 where the scene asks for a radius of 1, or names the scheme without a radius"};

const OwnOption tangent_option{
    {"-cable_tangent", "exact, or secant: the tangent without geometric stiffness, for comparison"},
    "exact or secant",
    "exact"};

const OwnOption elimination_limit_option{
    {"-cable_elimination_limit", "the most block products a node for the elimination of networks; beyond it MUMPS"},
    "block products a node, >= 0",
    "600"};

const OwnOption statics_monitor_option{
    {"-cable_statics_monitor", "shows the iterations on the way to equilibrium"}, "no value", "off"};

const OwnOption statics_time_limit_option{
    {"-cable_statics_time_limit", "how long to look for an equilibrium [s]; then exit status 3"},
    "seconds, >= 0",
    "no limit"};

const OwnOption most_gained_option{
    {"-cable_most_gained", "the most energy that a scheme may bring in from nowhere, over what the run moves"},
    "a number >= 0; 2 lets everything pass",
    "0.05"};

namespace {

constexpr std::array all{&axial_dissipation_option,  &tangent_option,
                         &elimination_limit_option,  &statics_monitor_option,
                         &statics_time_limit_option, &most_gained_option};

}   // namespace

std::span<const OwnOption* const> own_options() { return all; }

double read_number(const OwnOption& option, MPI_Comm communicator, const char* prefix, double fallback, double least,
                   double most) {
  const double value = petsc::number_option(communicator, prefix, option.text, fallback);
  if (value >= least && value <= most) return value;
  throw InputError(fmt::format("-{}{}: {} is not allowed; expected {}", prefix == nullptr ? "" : prefix,
                               option.text.name + 1, value, option.expected));
}

void show_own_options(MPI_Comm communicator) {
  for (const OwnOption* option : all) petsc::text_option(communicator, nullptr, option->text, option->fallback);
}

}   // namespace cablenet::solve
