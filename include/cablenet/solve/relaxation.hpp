#pragma once
#include "cablenet/system/assembler.hpp"

namespace cablenet::solve {

/// Lets a network settle in time from a shape at rest in a frame that moves at `velocity`: its held points stay where
/// they are at t, the water moves past, and a numerical damping that leaves nothing of vibrations (spectral radius 0,
/// steps as large as a thousandth of the network's size allows) and a damping by mass take the motion out.
/// Nothing carries compression, lest it stand on end.
/// Collective.  At most -relax_ts_max_steps steps; the options of its solvers have that prefix, too.
/// @param x  the shape, and what becomes of it
/// @param duration [s]
/// @returns false where the run through time failed; x is then its last good state
bool relax(const system::Assembler& assembler, double t, const Vector3& velocity, double duration, Vec x);

}   // namespace cablenet::solve
