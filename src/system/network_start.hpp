#pragma once
#include <petscvec.h>

#include "cablenet/system/local_state.hpp"

/// The state at a network's start, in the solver's vectors.
namespace cablenet::system {

void fill_start(const partition::LocalNetwork& network, Vec x, Vec v);

/// Makes a state's positions and attitudes the network's start.  All that is not held or moved then moves at `velocity`
/// [m/s] without turning.
void set_start(const LocalState& state, const Vector3& velocity, partition::LocalNetwork& network);

/// An index into Network::bodies of one on any rank whose Euler angles are singular within a degree of pitch; -1: none.
/// Collective.
int find_nearly_singular(const partition::LocalNetwork& network, Vec x, MPI_Comm communicator);

}   // namespace cablenet::system
