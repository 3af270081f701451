#pragma once
#include "cablenet/environment/fluid.hpp"
#include "term.hpp"

namespace cablenet::system {

/// What the loads of water have in common: the scene's water, and the same without waves.
class WaterTerm : public Term {
public:
  explicit WaterTerm(const partition::LocalNetwork& network)
      : Term(network), fluid_(network.surroundings.fluid), calm_(fluid_) {
    if (calm_) calm_->waves.clear();
  }

  bool has_rates() const { return fluid_.has_value(); }
  bool is_symmetric(const ForceRule&) const { return !fluid_; }

protected:
  /// @pre there is water
  const environment::Fluid& fluid(bool is_calm) const { return is_calm ? *calm_ : *fluid_; }

private:
  std::optional<environment::Fluid> fluid_, calm_;
};

}   // namespace cablenet::system
