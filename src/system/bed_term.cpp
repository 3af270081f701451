#include "bed_term.hpp"

#include "cablenet/environment/bed_contact.hpp"
#include "element_loops.hpp"

namespace cablenet::system {
namespace {

/// The bed's force on an end of an element, which stands for half the element's length.
struct BedKernel {
  static constexpr bool owns_slots = false;

  const partition::LocalNetwork& network;
  environment::Bed bed;
  double softness;
  double dt;

  BedKernel(const partition::LocalNetwork& here, double by, double step)
      : network(here), bed(*here.surroundings.bed), softness(by), dt(step) {
    bed.stiffness /= by;
    bed.damping /= by;
  }

  template <bool with_tangent, class Nodes, class Key>
  bool evaluate(std::size_t element, Key node, const Nodes& nodes, NodeResponse& out) const {
    const partition::LocalElement& e = network.elements[element];
    const network::CableOnBed& cable = network.surroundings.on_bed[at(e.material)];
    const double smoothing = softness * cable.smoothing;
    const ConstVector x = nodes.x(node), v = nodes.v(node);
    if (x.z() - 0.5 * dt * std::abs(v.z()) > bed.level + smoothing) return false;
    const environment::BedForce push =
        environment::bed_force<with_tangent>(bed, 0.5 * cable.diameter * e.length, smoothing, dt, x, v);
    out.on = -push.force;
    if constexpr (with_tangent) {
      out.x = -push.by_x;
      out.v = -push.by_v;
      out.a.setZero();
    }
    return true;
  }
};

}   // namespace

void BedTerm::add(Evaluation& evaluation) {
  const double softness = evaluation.situation.bed_softness;
  if (!network_.surroundings.bed || softness == 0) return;
  BedKernel kernel(network_, softness, evaluation.situation.stage.dt);
  if (evaluation.situation.internal == InternalForce::of_statics) kernel.bed.damping = 0;
  add_to_ends(evaluation, kernel, evaluation.target.shift);
}

void BedTerm::add_potential(const Situation& situation, const LocalState& state, double& sum) const {
  const auto& bed = network_.surroundings.bed;
  const double softness = situation.bed_softness;
  if (!bed || softness == 0) return;
  for (const partition::LocalElement& e : own_elements()) {
    const network::CableOnBed& cable = network_.surroundings.on_bed[at(e.material)];
    const double stiffness = bed->stiffness / softness * 0.5 * cable.diameter * e.length;
    for (const LocalNode node : e.node)
      sum += stiffness *
             environment::indentation_integral(bed->level - state.position(node).z(), softness * cable.smoothing);
  }
}

void BedTerm::add_scales(const LocalState&, ForceSums& sums) const {
  const auto& bed = network_.surroundings.bed;
  if (!bed) return;
  for (const partition::LocalElement& e : own_elements())
    sums.bed += square(bed->level * bed->stiffness * network_.surroundings.on_bed[at(e.material)].diameter * e.length);
}

Vector3 BedTerm::end_force(const LocalState& state, int element, std::size_t end) const {
  if (!network_.surroundings.bed) return Vector3::Zero();
  NodeResponse response;
  const LocalNode node = network_.elements[at(element)].node[end];
  const bool touches = BedKernel(network_, 1, 0).evaluate<false>(at(element), node, StateNodes{state}, response);
  return touches ? response.on : Vector3::Zero();
}

}   // namespace cablenet::system
