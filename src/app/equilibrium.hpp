#pragma once
#include <optional>
#include <string>

#include "cablenet/app/report.hpp"
#include "cablenet/network/network.hpp"
#include "cablenet/scene/scene.hpp"
#include "cablenet/solve/statics.hpp"

/// A scene's equilibrium, and what is said of it.
/// Tests: tests/verification/statics.py, stiffness.py
namespace cablenet::app {

/// All member functions are collective.
class Equilibrium {
public:
  /// @param assembler  whose start is what is drawn
  Equilibrium(const scene::Scene& scene, const scene::Time& time, system::Assembler& assembler);

  /// @returns whether there is one; the assembler then starts from it, otherwise from the best shape on the way to it
  bool find(const network::Network& network, Report& report);
  /// To who has none.
  const char* advice() const;
  std::string linear_solver() const { return statics_->linear_solver(); }

private:
  void add_notes(const network::Network& network, Report& report);

  const scene::Scene& scene_;
  double t_;
  system::Assembler& assembler_;
  Vector3 frame_;   ///< in which all is at rest [m/s]
  std::optional<solve::Statics> statics_;
};

/// "cable trunk, element 3 of 24" or "body fish".
std::string name_of(const network::Network& network, const solve::FailedPart& failed);

}   // namespace cablenet::app
