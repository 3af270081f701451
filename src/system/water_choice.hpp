#pragma once
#include <optional>

#include "cablenet/elements/cable_in_water.hpp"
#include "cablenet/environment/fluid.hpp"
#include "cablenet/network/surroundings.hpp"

namespace cablenet::system {

/// The scene's water, and the same without waves.
class WaterChoice {
public:
  explicit WaterChoice(const network::Surroundings& surroundings)
      : fluid_(surroundings.fluid), calm_(surroundings.fluid) {
    if (calm_) calm_->waves.clear();
  }
  bool exists() const { return fluid_.has_value(); }
  /// @pre exists()
  const environment::Fluid& fluid(bool is_calm) const { return is_calm ? *calm_ : *fluid_; }

private:
  std::optional<environment::Fluid> fluid_, calm_;
};

/// Calls visit(water) with the type of water that the fluid needs, and no richer one.
template <class Visit>
void visit_water(const environment::Fluid& fluid, double t, double gravity, Visit&& visit) {
  if (fluid.surface) return visit(elements::VaryingWater<true>{fluid, t, gravity});
  if (fluid.varies()) return visit(elements::VaryingWater<false>{fluid, t, gravity});
  const Vector3 velocity = fluid.current.empty() ? Vector3(0, 0, 0) : fluid.current.front().velocity;
  visit(elements::UniformWater{velocity, gravity});
}

}   // namespace cablenet::system
