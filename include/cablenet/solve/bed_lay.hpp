#pragma once
#include "cablenet/system/assembler.hpp"

namespace cablenet::solve {

/// Where each local node lay on the bed before it was pulled.  Friction holds it there, and a pull along the bed has to
/// overcome that.
///
/// Cables are laid without stretch, from the prescribed nodes on the bed on: the next node lies an unstretched length
/// farther, in the direction of the element as drawn.  A slack element lies as it is drawn.  Where an element is not
/// drawn on the bed, it is taken as in the equilibrium.  What no prescribed node holds lies where it is drawn on the
/// bed, or else where it is in the equilibrium.  What is on the bed in neither has no such place.
///
/// Collective.  All ranks learn of all elements on the bed.  Tests: tests/verification/bed_friction.py
/// @param drawn  of the local nodes, as are the results [m]
/// @param equilibrium  of the network without friction
system::GripPlaces laid_on_bed(const partition::LocalNetwork& network, const Table<LocalNode, Vector3>& drawn,
                               const system::LocalState& equilibrium, MPI_Comm communicator);

}   // namespace cablenet::solve
