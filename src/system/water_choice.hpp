#pragma once
#include <optional>

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

}   // namespace cablenet::system
