#include "cable_water_term.hpp"

#include "cablenet/elements/cable_in_water_loads.hpp"
#include "element_loops.hpp"

namespace cablenet::system {
namespace {

template <class Water>
struct WaterKernel {
  using Response = PairResponse;
  using Apart = PairApart;
  static constexpr bool owns_slots = false;

  const partition::LocalNetwork& network;
  const Water& water;

  template <bool with_residual, bool with_tangent, class Nodes>
  bool evaluate(std::size_t, const partition::LocalElement& e, const Nodes& nodes, const Shift& shift,
                Response& out) const {
    const elements::CableInWater& cable = network.surroundings.in_water[at(e.material)];
    const auto n1 = nodes.key(e, 0), n2 = nodes.key(e, 1);
    const elements::EndMotion motion{
        {nodes.x(n1), nodes.x(n2)}, {nodes.v(n1), nodes.v(n2)}, {nodes.a(n1), nodes.a(n2)}};
    const elements::EndLoads loads = elements::water_loads<with_tangent>(cable, e.length, motion, water, shift);
    for (std::size_t i = 0; i < 2; ++i) {
      out.on[i] = -loads.on[i];
      if constexpr (with_tangent)
        for (std::size_t j = 0; j < 2; ++j) out.by[i][j] = -loads.by[i][j];
    }
    return true;
  }
};

}   // namespace

void CableWaterTerm::add(Evaluation& evaluation) {
  if (!has_rates()) return;
  Shift shift = evaluation.target.shift;
  if (evaluation.target.holds_water) shift.x = 0;
  elements::visit_water(fluid(evaluation.situation), evaluation.time(), network_.gravity,
                        [&]<class Water>(const Water& water) {
                          add_to_elements(evaluation, WaterKernel<Water>{network_, water}, shift);
                        });
}

Vector3 CableWaterTerm::end_force(const LocalState& state, int element, std::size_t end) const {
  PairResponse response{};
  if (!has_rates()) return Vector3::Zero();
  elements::visit_water(fluid(state.is_calm), state.t, network_.gravity, [&]<class Water>(const Water& water) {
    WaterKernel<Water>{network_, water}.template evaluate<true, false>(0, network_.elements[at(element)],
                                                                       StateNodes{state}, {}, response);
  });
  return response.on[end];
}

}   // namespace cablenet::system
