#include "bed_term.hpp"

#include "bed_rubbing.hpp"
#include "element_loops.hpp"

namespace cablenet::system {
namespace {

/// The ends of elements, each of which stands for half an element.  Contact i is end i % 2 of element i / 2.
struct CableEnds {
  const partition::LocalNetwork& network;

  const partition::LocalElement& element(std::size_t i) const { return network.elements[i / 2]; }
  const network::CableOnBed& cable(std::size_t i) const { return network.surroundings.on_bed[at(element(i).material)]; }
  static double softness(const Situation& situation) { return situation.bed_softness; }
  std::size_t size() const { return 2 * network.elements.size(); }
  LocalNode node(std::size_t i) const { return element(i).node[i % 2]; }
  double reach(std::size_t) const { return 0; }
  double area(std::size_t i) const { return 0.5 * cable(i).diameter * element(i).length; }
  double smoothing(std::size_t i) const { return cable(i).smoothing; }
  double friction_stiffness(std::size_t i) const { return cable(i).friction_stiffness; }
  double friction_delay(std::size_t i) const { return cable(i).friction_delay; }
};

}   // namespace

BedTerm::BedTerm(const partition::LocalNetwork& network) : Term(network) { grip(GripPlaces(network.nodes)); }

void BedTerm::grip(const GripPlaces& places) {
  if (sticks()) put_grips(CableEnds{network_}, *network_.surroundings.bed, places, grips_);
}

void BedTerm::begin_step(Evaluation& evaluation) {
  if (sticks()) begin_rubbing(CableEnds{network_}, *network_.surroundings.bed, evaluation, grips_);
}

void BedTerm::add(Evaluation& evaluation) {
  const auto& bed = network_.surroundings.bed;
  if (!bed || evaluation.situation.bed_softness == 0) return;
  visit_bed(CableEnds{network_}, *bed, evaluation.situation, evaluation.target.turning.is_cautious(), grips_,
            [&](const auto& kernel) { add_to_ends(evaluation, kernel, evaluation.target.shift); });
}

void BedTerm::add_potential(const Situation& situation, const LocalState& state, double& sum) const {
  const auto& bed = network_.surroundings.bed;
  if (!bed || situation.bed_softness == 0) return;
  sum += bed_potential(CableEnds{network_}, 2 * own_elements().size(), *bed, situation, grips_, state);
}

void BedTerm::add_scales(const LocalState&, ForceSums& sums) const {
  const auto& bed = network_.surroundings.bed;
  if (!bed) return;
  for (const partition::LocalElement& e : own_elements())
    sums.bed += square(bed->level * bed->stiffness * network_.surroundings.on_bed[at(e.material)].diameter * e.length);
}

Vector3 BedTerm::end_force(const LocalState& state, int element, std::size_t end) const {
  NodeResponse response;
  response.on.setZero();
  if (!network_.surroundings.bed) return response.on;
  const std::size_t contact = 2 * at(element) + end;
  visit_bed(CableEnds{network_}, *network_.surroundings.bed, {}, false, grips_, [&](const auto& kernel) {
    kernel.template evaluate<false>(contact, kernel.contacts.node(contact), StateNodes{state}, response);
  });
  return response.on;
}

}   // namespace cablenet::system
