#pragma once
#include <vector>

#include "bed_grips.hpp"
#include "term.hpp"

namespace cablenet::system {

/// Contact of points and bodies with the bed, and friction on it.  A body touches it with carried nodes.
/// Tests: tests/parallel/bed_spot_test.cpp, tests/parallel/bed_friction_test.cpp
class BedSpotTerm : public Term {
public:
  static constexpr Account account = Account::bed;
  explicit BedSpotTerm(const partition::LocalNetwork& network);

  bool has_rates() const { return !network_.bed_spots.empty(); }
  bool is_symmetric(const ForceRule&) const { return !network_.surroundings.bed; }
  void couplings(BlockPattern& pattern) { slots_ = pattern.own(network_.bed_spots); }
  void begin_step(Evaluation& evaluation);
  void add(Evaluation& evaluation);
  void add_potential(const Situation& situation, const LocalState& state, double& sum) const;
  void add_scales(const LocalState&, ForceSums& sums) const;
  Vector3 node_force(const LocalState& state, LocalNode node) const;
  void grip(const GripPlaces& places);
  void archive(Archive& archive) { grips_.archive(archive, "bed spots.grips"); }

private:
  bool sticks() const { return !network_.bed_spots.empty() && network_.surroundings.bed->sticks(); }

  std::vector<Slot> slots_;
  BedGrips grips_;   ///< of LocalNetwork::bed_spots; none where nothing sticks
};

}   // namespace cablenet::system
