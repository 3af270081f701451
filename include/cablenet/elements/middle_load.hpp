#pragma once
#include "cablenet/elements/cable_in_water.hpp"
#include "cablenet/elements/morison.hpp"
#include "cablenet/environment/water.hpp"

/// The load of water at the middle of an element's wetted part; cable_in_water_loads.hpp inlines it.
/// Source and tests: see cable_in_water.hpp.
namespace cablenet::elements {

inline Vector3 between(const std::array<Vector3, 2>& ends, double at) { return (1 - at) * ends[0] + at * ends[1]; }

/// The load at the middle of the wetted part, without added mass.  Water that does not vary has only p and flow.
struct MiddleLoad {
  CrossFlow flow;
  Vector3 p;   ///< [N/m]
  environment::WaterMotion water;
};

template <class Water>
MiddleLoad middle_load(const CableInWater& c, const Vector3& e, const EndMotion& m, double at, const Water& water) {
  const Vector3 v = between(m.v, at);
  if constexpr (!Water::varies) {
    const CrossFlow flow(c, e, water.velocity - v);
    return {flow, flow.drag() + c.displaced * water.gravity * Vector3::UnitZ(), {}};
  } else {
    const environment::WaterMotion motion = environment::water_motion(water.fluid, between(m.x, at), water.t);
    const CrossFlow flow(c, e, motion.velocity - v);
    return {flow, flow.drag() + c.displaced * (motion.acceleration + water.gravity * Vector3::UnitZ()), motion};
  }
}

/// The derivatives of p and of added mass times the water's acceleration, by the place of the middle.
inline Matrix3 by_place(const CableInWater& c, const Vector3& e, const MiddleLoad& middle) {
  const Matrix3& slope = middle.water.acceleration_slope;
  return middle.flow.by_flow().lazyProduct(middle.water.velocity_slope) + c.displaced * slope +
         c.added * across(e).lazyProduct(slope);
}

}   // namespace cablenet::elements
