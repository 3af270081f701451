#pragma once
#include <mpi.h>

#include "cablenet/partition/local_network.hpp"

/// What can take energy from a network.  Tests: tests/parallel/energy_test.cpp
namespace cablenet::system {

bool is_damped(const elements::CableMaterial& material);

/// Nothing but the step's formulas can take energy or bring any in: there is no water, no bed, no damping, and no bar,
/// whose moment has no potential.  What the formulas have taken is then the fall of kinetic + strain + gravity - work
/// since the start.  Collective.
bool only_formulas_take_energy(const partition::LocalNetwork& network, MPI_Comm communicator);

}   // namespace cablenet::system
