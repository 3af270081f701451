#pragma once
#include <optional>
#include <string>

#include "cablenet/app/report.hpp"
#include "cablenet/network/network.hpp"
#include "cablenet/scene/scene.hpp"
#include "cablenet/solve/pretension.hpp"
#include "cablenet/solve/statics.hpp"

/// A scene's equilibrium, with the lengths that tensions ask for, and what is said of it.
/// Tests: tests/verification/statics.py, pretension.py, stiffness.py
namespace cablenet::app {

/// All member functions are collective.
class Equilibrium {
public:
  /// @param assembler  whose start is what is drawn
  Equilibrium(const scene::Scene& scene, const scene::Time& time, system::Assembler& assembler);

  /// Unstretched lengths that tensions ask for, which become those of the network and of the assembler.
  /// @returns whether they were found, or none are asked for
  bool find_lengths(network::Network& network, Report& report);
  /// @returns whether there is one; the assembler then starts from it, otherwise from the best shape on the way to it
  bool find(const network::Network& network, Report& report);
  /// To who has none.
  const char* advice() const;
  std::string linear_solver() const { return statics_->linear_solver(); }

private:
  void describe_lengths(const network::Network& network, const solve::PretensionSearch& search, Report& report) const;
  std::string failed_lengths(const network::Network& network, const solve::PretensionSearch& search) const;
  void add_notes(const network::Network& network, Report& report);

  const scene::Scene& scene_;
  double t_;
  system::Assembler& assembler_;
  Vector3 frame_;   ///< in which all is at rest [m/s]
  std::optional<solve::Statics> statics_;
  int iterations_ = 0;   ///< before that of statics_
  bool has_lengths_ = true;
};

/// "cable trunk, element 3 of 24" or "body fish".
std::string name_of(const network::Network& network, const solve::FailedPart& failed);

}   // namespace cablenet::app
