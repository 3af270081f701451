#pragma once
#include <tuple>
#include <vector>

#include "cablenet/elements/energy_momentum_law.hpp"
#include "law_choice.hpp"
#include "term.hpp"

namespace cablenet::system {

/// The cables' elements: inertia, weight, mass damping and the internal force, by the law that the situation asks for.
/// It comes first, as it writes the elements' blocks, to which the others add.
/// Tests: tests/parallel/assembler_test.cpp
class CableTerm : public Term {
public:
  explicit CableTerm(const partition::LocalNetwork& network);

  bool has_rates() const { return is_general_; }
  bool is_symmetric(const ForceRule& rule) const;
  void couplings(BlockPattern& pattern) { pattern.add_elements(); }
  void begin_step(Evaluation& evaluation);
  void add(Evaluation& evaluation);
  void add_energy(const LocalState& state, Energies& sum) const;
  void add_potential(const Situation& situation, const LocalState& state, double& sum) const;
  void add_scales(const LocalState& state, ForceSums& sums) const;
  void end_step(const StepEnd& end) { taken_ = {end.stage.dt, step_pace(end.stage.dt, before_.dt)}; }
  Vector3 end_force(const LocalState& state, int element, std::size_t end) const;
  void archive(Archive& archive);
  /// The elements at the running step's start, where the law in use keeps them.
  std::span<const elements::ReachedStart> reached() const {
    return std::get<std::vector<elements::ReachedStart>>(starts_);
  }

private:
  template <class Law>
  std::vector<typename Law::Start>& starts();
  elements::Turning turning(const Evaluation& evaluation);

  bool is_general_;   ///< Some material is damped, or goes slack.
  /// What the laws keep of each element at the step's start: one array per kind.  Only the law in use has elements.
  std::tuple<std::vector<elements::NoStart>, std::vector<elements::AveragedStart<false>>,
             std::vector<elements::AveragedStart<true>>, std::vector<elements::ReachedStart>,
             std::vector<elements::StaticStart>>
      starts_;
  StepBefore taken_;    ///< the last accepted step
  StepBefore before_;   ///< the step before the running one
  /// The chords' directions at the last tangent, and where those at the present one are kept.
  std::array<std::vector<Vector3>, 2> directions_;
};

}   // namespace cablenet::system
