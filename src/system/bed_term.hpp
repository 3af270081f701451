#pragma once
#include "bed_grips.hpp"
#include "term.hpp"

namespace cablenet::system {

/// Contact of cables with the bed, and friction on it.  Each end of an element is a contact of its own, which stands
/// for half the element.  Tests: tests/parallel/surroundings_test.cpp, tests/parallel/bed_friction_test.cpp
class BedTerm : public Term {
public:
  static constexpr Account account = Account::bed;
  explicit BedTerm(const partition::LocalNetwork& network);

  bool has_rates() const { return network_.surroundings.bed.has_value(); }
  bool is_symmetric(const ForceRule&) const { return !has_rates(); }
  void begin_step(Evaluation& evaluation);
  void add(Evaluation& evaluation);
  void add_potential(const Situation& situation, const LocalState& state, double& sum) const;
  void add_scales(const LocalState&, ForceSums& sums) const;
  Vector3 end_force(const LocalState& state, int element, std::size_t end) const;
  void grip(const GripPlaces& places);
  void archive(Archive& archive) { grips_.archive(archive, "bed.grips"); }

private:
  bool sticks() const { return network_.surroundings.bed && network_.surroundings.bed->sticks(); }

  BedGrips grips_;   ///< one per end of an element; empty if the bed has no friction by springs
};

}   // namespace cablenet::system
