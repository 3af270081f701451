#pragma once
#include "cablenet/environment/fluid.hpp"
#include "term.hpp"

namespace cablenet::system {

/// The base of all terms that load something by water.  It keeps the scene's water three times: as it is, without
/// waves, and at rest.
class WaterTerm : public Term {
public:
  explicit WaterTerm(const partition::LocalNetwork& network)
      : Term(network), fluid_(network.surroundings.fluid), calm_(fluid_) {
    if (calm_) calm_->waves.clear();
    still_ = calm_;
    if (still_) still_->current.clear();
  }

  bool has_rates() const { return fluid_.has_value(); }
  bool is_symmetric(const ForceRule&) const { return !fluid_; }

protected:
  /// @pre there is water
  const environment::Fluid& fluid(bool is_calm, bool is_still = false) const {
    return is_still ? *still_ : is_calm ? *calm_ : *fluid_;
  }
  const environment::Fluid& fluid(const Situation& now) const { return fluid(now.is_calm, now.is_still); }

private:
  std::optional<environment::Fluid> fluid_, calm_, still_;
};

}   // namespace cablenet::system
