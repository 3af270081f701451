#include "bed_spot_term.hpp"

#include "bed_rubbing.hpp"
#include "item_loops.hpp"

namespace cablenet::system {
namespace {

struct Spots {
  const std::vector<network::BedSpot<LocalNode>>& spots;

  static double softness(const Situation& situation) { return situation.spot_softness; }
  std::size_t size() const { return spots.size(); }
  LocalNode node(std::size_t i) const { return spots[i].node; }
  double reach(std::size_t i) const { return spots[i].radius; }
  double area(std::size_t i) const { return spots[i].area; }
  double smoothing(std::size_t i) const { return spots[i].smoothing; }
  double friction_stiffness(std::size_t i) const { return spots[i].friction_stiffness; }
  double friction_delay(std::size_t i) const { return spots[i].friction_delay; }
};

}   // namespace

BedSpotTerm::BedSpotTerm(const partition::LocalNetwork& network) : Term(network) { grip(GripPlaces(network.nodes)); }

void BedSpotTerm::grip(const GripPlaces& places) {
  if (sticks()) put_grips(Spots{network_.bed_spots}, *network_.surroundings.bed, places, grips_);
}

void BedSpotTerm::begin_step(Evaluation& evaluation) {
  if (sticks()) begin_rubbing(Spots{network_.bed_spots}, *network_.surroundings.bed, evaluation, grips_);
}

void BedSpotTerm::add(Evaluation& evaluation) {
  if (network_.bed_spots.empty() || evaluation.situation.spot_softness == 0) return;
  visit_bed(Spots{network_.bed_spots}, *network_.surroundings.bed, evaluation.situation,
            evaluation.target.turning.is_cautious(), grips_,
            [&](const auto& kernel) { add_to_nodes(evaluation, kernel, network_.bed_spots, slots_); });
}

void BedSpotTerm::add_potential(const Situation& situation, const LocalState& state, double& sum) const {
  if (network_.bed_spots.empty() || situation.spot_softness == 0) return;
  const Spots spots{network_.bed_spots};
  sum += bed_potential(spots, spots.size(), *network_.surroundings.bed, situation, grips_, state);
}

void BedSpotTerm::add_scales(const LocalState&, ForceSums& sums) const {
  for (const auto& spot : network_.bed_spots)
    sums.bed += square(network_.surroundings.bed->level * network_.surroundings.bed->stiffness * spot.area);
}

Vector3 BedSpotTerm::node_force(const LocalState& state, LocalNode node) const {
  Vector3 sum = Vector3::Zero();
  if (network_.bed_spots.empty()) return sum;
  visit_bed(Spots{network_.bed_spots}, *network_.surroundings.bed, {}, false, grips_, [&](const auto& kernel) {
    for (std::size_t i = 0; i < network_.bed_spots.size(); ++i) {
      NodeResponse response;
      if (network_.bed_spots[i].node != node) continue;
      if (kernel.template evaluate<false>(i, node, StateNodes{state}, response)) sum += response.on;
    }
  });
  return sum;
}

}   // namespace cablenet::system
