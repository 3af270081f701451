#pragma once
#include "cablenet/solve/static_progress.hpp"
#include "cablenet/system/assembler.hpp"

namespace cablenet::solve {

/// It begins the names of all options of the solvers that let a network settle.
inline constexpr const char* relaxation_prefix = "relax_";

/// Lets a network settle in time from a shape at rest in a frame that moves at `velocity`.  In that frame its held
/// points stay where they are at t, and the water moves past.  Two dampings take the motion out: one by mass, and that
/// of the scheme, which at spectral radius 0 and with long steps leaves nothing of vibrations.  No element carries
/// compression here, because one that does could come to rest standing on end.
/// Collective.  Takes at most 400 steps, or -relax_ts_max_steps, and ends where the time of statics is over.
/// @param x  the shape to start from; afterwards the shape that it has settled to
/// @param duration [s]
/// @returns false where the run through time failed; x is then its last good state
bool relax(const system::Assembler& assembler, double t, const Vector3& velocity, double duration,
           StaticProgress& progress, Vec x);

/// The local error that a step may have while the network settles: a thousandth of the network's extent.  [m]
double relaxation_tolerance(const partition::LocalNetwork& network);

}   // namespace cablenet::solve
