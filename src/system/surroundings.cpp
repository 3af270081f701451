#include "access.hpp"
#include "attached_surroundings.hpp"
#include "body_set.hpp"
#include "cablenet/bodies/body_in_water.hpp"
#include "cablenet/petsc/phase.hpp"

/// Water and bed, for scenes that have them.
namespace cablenet::system {
namespace {

/// Calls visit(water) with what the scene's water needs and no more.
template <class Visit>
void visit_water(const environment::Fluid& fluid, double t, double gravity, Visit&& visit) {
  if (fluid.surface) return visit(elements::VaryingWater<true>{fluid, t, gravity});
  if (fluid.varies()) return visit(elements::VaryingWater<false>{fluid, t, gravity});
  const Vector3 velocity = fluid.current.empty() ? Vector3(0, 0, 0) : fluid.current.front().velocity;
  visit(elements::UniformWater{velocity, gravity});
}

bodies::PointMotion point_motion(const AnyNodes& nodes, LocalNode node) {
  using Const3 = Eigen::Map<const Vector3>;
  return {Const3(nodes.x(node)), Const3(nodes.v(node)), Const3(nodes.a(node))};
}

}   // namespace

struct Assembler::SurroundingsSweep {
  const Assembler& assembler;
  Access& access;
  double t, dt;
  SurroundingsTarget target, in_water;
  bool holds_turning;
  AttachedBlocks blocks;
  const partition::LocalNetwork& network = assembler.network_;
  AnyNodes nodes{access.data};

  /// Calls visit(range, nodes) for all elements but those at bodies.
  template <class Visit>
  void visit_ranges(Visit&& visit) const {
    visit(Range{0, network.inner_elements}, InnerNodes{access.data});
    visit(Range{network.inner_elements, network.attached.first}, nodes);
    visit(Range{network.attached.last, static_cast<int>(network.elements.size())}, nodes);
  }

  template <bool with_tangent>
  void add_water() const {
    visit_water(assembler.water(), t, network.gravity, [&]<class Water>(const Water& water) {
      visit_ranges([&]<class Nodes>(Range range, const Nodes& ends) {
        for_each_element(network, range, WaterWork<Water, Nodes, with_tangent>{network, water, ends, in_water});
      });
      for_each_element(network, network.attached,
                       AttachedWaterWork<Water, with_tangent>{network, water, nodes, in_water, blocks});
    });
  }

  template <bool with_tangent>
  void add_bed() const {
    const SoftBed bed{*network.surroundings.bed, assembler.bed_softness_};
    visit_ranges([&]<class Nodes>(Range range, const Nodes& ends) {
      for_each_element(network, range, BedWork<Nodes, with_tangent>{network, bed, ends, target, dt});
    });
    for_each_element(network, network.attached, AttachedBedWork<with_tangent>{network, bed, nodes, target, blocks, dt});
  }

  /// Centres of buoyancy.
  template <bool with_tangent>
  void add_carried_points() const {
    for (const auto& [node, thing] : network.wet_points) {
      if (!network.is_carried(node)) continue;
      const bodies::PointLoad load =
          bodies::point_load(thing, assembler.water(), t, network.gravity, point_motion(nodes, node));
      add_attached_force(network, nodes, node, -load.force);
      if constexpr (with_tangent) blocks.add(node, node, {}, {-load.by_x, -load.by_v, -load.by_a}, target.follow);
    }
  }

  template <bool with_tangent>
  void run() const {
    if (network.surroundings.fluid) add_water<with_tangent>();
    if (network.surroundings.bed && assembler.bed_softness_ > 0) add_bed<with_tangent>();
    if (!network.surroundings.fluid || network.bodies.empty()) return;
    add_carried_points<with_tangent>();
    assembler.bodies_->add_water(assembler.water(), t, access.data, with_tangent ? &target.follow : nullptr,
                                 !holds_turning);
  }
};

Vector3 Assembler::surroundings_force(const partition::LocalElement& e, std::size_t end) const {
  Vector3 force(0, 0, 0);
  elements::EndMotion motion;
  for (std::size_t k = 0; k < 2; ++k) {
    motion.x[k] = LocalState::at(state_.x, e.node[k]);
    motion.v[k] = LocalState::at(state_.v, e.node[k]);
    motion.a[k] = LocalState::at(state_.a, e.node[k]);
  }
  const auto material = static_cast<std::size_t>(e.material);
  if (network_.surroundings.fluid)
    visit_water(water(), state_.t, network_.gravity, [&](const auto& water) {
      force +=
          elements::water_loads<false>(network_.surroundings.in_water[material], e.length, motion, water, {}).on[end];
    });
  if (network_.surroundings.bed) {
    const auto& [diameter, smoothing] = network_.surroundings.on_bed[material];
    force += environment::bed_force<false>(*network_.surroundings.bed, 0.5 * diameter * e.length, smoothing, 0,
                                           motion.x[end], motion.v[end])
                 .force;
  }
  return force;
}

void Assembler::add_surroundings(const Stage& stage, Access& access, const TangentRequest* request) {
  const petsc::Timer timer(access.has_residual() ? petsc::Phase::residual : petsc::Phase::tangent);
  SurroundingsTarget target{{}, {}, access.has_residual()};
  if (request != nullptr) {
    target.tangent = {request->matrix.values(), request->matrix.element_slots().data(), request->shift_v,
                      request->shift_a};
    target.follow = {request->shift_x, request->shift_v, request->shift_a};
  }
  const AttachedBlocks blocks(network_, *bodies_, target.tangent);
  SurroundingsTarget in_water = target;
  if (request != nullptr && request->holds_water) in_water.follow.x = 0;
  const SurroundingsSweep sweep{*this,
                                access,
                                stage.t + stage.alpha_f * stage.dt,
                                stage.dt,
                                target,
                                in_water,
                                request != nullptr && request->steadiness > 0,
                                blocks};
  request != nullptr ? sweep.run<true>() : sweep.run<false>();
}

void Assembler::add_wet_points(double t, Access& access, const TangentRequest* request) {
  const AnyNodes nodes{access.data};
  for (std::size_t i = 0; i < network_.wet_points.size(); ++i) {
    const auto& [node, thing] = network_.wet_points[i];
    if (network_.is_carried(node)) continue;
    const bodies::PointLoad load = bodies::point_load(thing, water(), t, network_.gravity, point_motion(nodes, node));
    if (access.has_residual()) Eigen::Map<Vector3>(nodes.r(node)) -= load.force;
    if (request == nullptr) continue;
    const TangentTarget target{request->matrix.values(), nullptr, 0, 0};
    subtract_block<AnyNodes>(
        target, request->matrix.wet_slots()[i],
        request->shift_x * load.by_x + request->shift_v * load.by_v + request->shift_a * load.by_a);
  }
}

}   // namespace cablenet::system
