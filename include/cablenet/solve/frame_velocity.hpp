#pragma once
#include "cablenet/system/assembler.hpp"

namespace cablenet::solve {

/// A velocity for the frame, from those of the prescribed nodes.  [m/s]
/// If all of them have one velocity in the first fifth of the window, it is that one.  Otherwise each component is
/// the middle between the least and the largest that occur in the window.  It is zero where these two differ by more
/// than a quarter of the middle, as in heave, at a start from rest, or where one point stays and another moves.
/// Collective.
/// @param window  from t on [s]
Vector3 frame_velocity(const system::Assembler& assembler, double t, double window);

}   // namespace cablenet::solve
