#pragma once
#include <petscvec.h>

#include "cablenet/partition/local_network.hpp"

namespace cablenet::solve {

/// Moves x slightly: nodes by up to a hundredth of the shortest element there, attitudes by up to 0.01 rad.  The
/// numbers depend on the scene alone, so that ranks do not matter.
void disturb(const partition::LocalNetwork& network, Vec x);

}   // namespace cablenet::solve
