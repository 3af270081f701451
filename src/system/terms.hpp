#pragma once
#include <tuple>

#include "bed_spot_term.hpp"
#include "bed_term.hpp"
#include "body_term.hpp"
#include "body_water_term.hpp"
#include "cable_term.hpp"
#include "cable_water_term.hpp"
#include "link_term.hpp"
#include "point_force_term.hpp"
#include "point_term.hpp"
#include "point_water_term.hpp"

namespace cablenet::system {

/// All physics, in the order in which an evaluation calls them.  A new term is one line here.  Cables come first, as
/// they write the blocks of elements.  Bodies come last, as they collect what the others leave on carried nodes.
using Terms = std::tuple<CableTerm, LinkTerm, CableWaterTerm, BedTerm, PointTerm, PointForceTerm, PointWaterTerm,
                         BedSpotTerm, BodyWaterTerm, BodyTerm>;

}   // namespace cablenet::system
