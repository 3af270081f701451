#include "cablenet/system/static_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "static_law.hpp"
#include "sweep.hpp"

#include "cablenet/bodies/rigid_body.hpp"
#include "cablenet/elements/cable.hpp"

namespace cablenet::system {
namespace {

using petsc::check;

double square(double value) { return value * value; }

Eigen::Map<Vector3> as_vector(double* values) { return Eigen::Map<Vector3>(values); }

/// Of a component of the velocity: within this part the tow points agree, and in a first part of the window are steady.
/// Surge on a tow agrees; a harmonic motion by itself changes more within a tenth of a run that has more than a period.
constexpr double agreement = 0.25, steadiness = 1e-6, first_part = 0.2;

/// A node's contact over an element, in stiffness at most, until the cables are as they are.  Soft enough that the
/// number of iterations does not grow with the bed's stiffness or the number of elements.
constexpr double bed_over_cables = 1e-4;

/// Where the cables carry next to nothing.
constexpr double softest_bed = 1e12;

/// At how many times within the window a motion is looked at.
constexpr int samples = 8;

/// Sets the bodies' and nodes' velocities.
void fill_velocity(const partition::LocalNetwork& network, const Vector3& velocity, Vec v) {
  double* values = nullptr;
  check(VecSet(v, 0));
  check(VecGetArray(v, &values));
  for (LocalNode node(0); network.is_owned(node); ++node) as_vector(values + network.begin[node].value()) = velocity;
  check(VecRestoreArray(v, &values));
}

/// Stiffness x diameter x L^2, the largest: of contact over that of an element, times EA.  [N]
double measure_bed(const partition::LocalNetwork& network, MPI_Comm communicator) {
  double largest = 0;
  if (!network.surroundings.bed) return 0;
  for (int i = 0; i < network.own_elements; ++i) {
    const partition::LocalElement& e = network.elements[at(i)];
    largest = std::max(largest, network.surroundings.on_bed[at(e.material)].diameter * e.length * e.length);
  }
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, communicator);
  return network.surroundings.bed->stiffness * largest;
}

double softest_cable(const partition::LocalNetwork& network) {
  double least = std::numeric_limits<double>::max();
  for (const auto& material : network.materials) least = std::min(least, material.axial_stiffness);
  return least;
}

}   // namespace

StaticForces::StaticForces(Assembler& assembler, double t, const Vector3& velocity)
    : assembler_(assembler),
      t_(t),
      velocity_(velocity),
      v_(assembler.make_vector()),
      resting_(assembler.make_vector()) {
  fill_velocity(assembler_.network_, velocity_, v_);
  assembler_.start_prescribed(t_);
  stiffest_bed_ = measure_bed(assembler_.network_, assembler_.communicator_);
  if (!assembler_.network_.surroundings.fluid) return;
  assembler_.calm_ = assembler_.network_.surroundings.fluid;
  assembler_.calm_->waves.clear();
}

StaticForces::~StaticForces() { assembler_.calm_.reset(); }

bool StaticForces::find_common_velocity(const Assembler& assembler, double t, double window, double tolerance,
                                        Vector3& common) {
  double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300};
  for (const auto& [node, motion] : assembler.network_.prescribed)
    for (int i = 0; i <= samples; ++i) {
      const double when = std::min(t + window * i / samples, motion.last_time());
      const Vector3 v = motion.at(when).v;
      for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], v(k)), high[k] = std::max(high[k], v(k));
    }
  MPI_Allreduce(MPI_IN_PLACE, low, 3, MPI_DOUBLE, MPI_MIN, assembler.communicator_);
  MPI_Allreduce(MPI_IN_PLACE, high, 3, MPI_DOUBLE, MPI_MAX, assembler.communicator_);
  bool agree = true;
  common.setZero();
  for (int k = 0; k < 3; ++k) {
    const double middle = 0.5 * (low[k] + high[k]);
    const bool agrees = high[k] - low[k] <= tolerance * std::abs(middle);
    if (agrees) common(k) = middle;
    agree = agree && agrees;
  }
  return agree;
}

Vector3 StaticForces::frame_velocity(const Assembler& assembler, double t, double window) {
  Vector3 common;
  if (!find_common_velocity(assembler, t, first_part * window, steadiness, common))
    find_common_velocity(assembler, t, window, agreement, common);
  return common;
}

bool StaticForces::is_in_flow() const {
  const auto& fluid = assembler_.network_.surroundings.fluid;
  return fluid && (!velocity_.isZero(0) || !fluid->current.empty());
}

void StaticForces::place_prescribed() {
  assembler_.evaluated_ = {};
  for (std::size_t i = 0; i < assembler_.prescribed_.size(); ++i) {
    NodeMotion& here =
        assembler_.outside_[at(assembler_.network_.prescribed[i].node.value() - assembler_.network_.owned)];
    as_vector(here.x) = assembler_.prescribed_[i].start.x;
    as_vector(here.v) = velocity_;
    as_vector(here.a).setZero();
  }
}

void StaticForces::keep(Vec x) {
  Assembler::Access access(assembler_, x, v_, nullptr, nullptr);
  access.begin_exchange();
  place_prescribed();
  access.finish_exchange();
  assembler_.bodies_->begin_step(access.data);
  assembler_.record_starts(StaticLaw{}, access);
}

/// Against soft cables a hard bed is a wall, before which Newton's steps shrink to nothing.
double StaticForces::bed_softness(const StaticRule& rule) const {
  if (rule.kind == StaticRule::Kind::exact) return 1;
  const double cable =
      rule.kind == StaticRule::Kind::strings ? rule.string_tension * rule.exponent : softest_cable(assembler_.network_);
  return std::clamp(stiffest_bed_ / (bed_over_cables * cable), 1.0, softest_bed);
}

bool StaticForces::residual(const StaticRule& rule, Vec x, Vec r, TangentMatrix* tangent, const Steadying& steadying) {
  const Stage instant{t_, 0, 0};
  Assembler::Access access(assembler_, x, v_, resting_, r);
  access.begin_exchange();
  place_prescribed();
  assembler_.coincident_ = -1;
  std::optional<TangentRequest> request;
  if (tangent != nullptr) {
    const bool exact = rule.kind == StaticRule::Kind::exact;
    const bool linear = rule.kind == StaticRule::Kind::strings && rule.exponent == 1;
    request.emplace(TangentRequest{*tangent, steadying.pseudo_rate, square(steadying.pseudo_rate), 1, linear,
                                   exact ? 0 : steadying.steadiness});
  }
  const TangentRequest* const wanted = request ? &*request : nullptr;
  assembler_.bed_softness_ = bed_softness(rule);
  const bool in_domain = rule.kind == StaticRule::Kind::exact
                             ? assembler_.run(StageLaw<true>{assembler_.rule_.tangent}, instant, access, wanted)
                             : assembler_.run(StaticLaw{rule}, instant, access, wanted);
  assembler_.add_loads(t_, access, wanted);
  assembler_.bed_softness_ = 1;
  access.close();
  if (tangent != nullptr) tangent->publish();
  return in_domain;
}

void StaticForces::loads(Vec x, Vec r) {
  Assembler::Access access(assembler_, x, v_, resting_, r);
  access.begin_exchange();
  place_prescribed();
  // The bed answers the others, enormously where the drawn shape lies in it.
  assembler_.bed_softness_ = 0;
  assembler_.run(NoLaw{}, {t_, 0, 0}, access, nullptr);
  assembler_.add_loads(t_, access, nullptr);
  assembler_.bed_softness_ = 1;
}

TensionRange StaticForces::tensions(Vec x) {
  const LocalState& state = assembler_.observe(t_, x, v_, resting_);
  double range[2] = {0, 0};   // what counts against least, and largest
  const auto& network = assembler_.network_;
  for_each_element(network, {0, network.own_elements}, [&](std::size_t, const partition::LocalElement& e) {
    const elements::CableMaterial& material = network.materials[at(e.material)];
    const double T = elements::cable_tension(material, e.length, {state.chord(e).d, Vector3::Zero()});
    range[0] = std::max(range[0], -T);
    range[1] = std::max(range[1], std::abs(T));
    return true;
  });
  MPI_Allreduce(MPI_IN_PLACE, range, 2, MPI_DOUBLE, MPI_MAX, assembler_.communicator_);
  return {-range[0], range[1]};
}

void StaticForces::start_from(Vec x) {
  const LocalState state = assembler_.observe(t_, x, v_, resting_);
  partition::LocalNetwork& network = assembler_.network_;
  for (LocalNode i(0); i.value() < network.nodes; ++i) {
    network.position[i] = LocalState::at(state.x, i);
    network.velocity[i] = network.is_free(i) || network.is_carried(i) ? velocity_ : Vector3(LocalState::at(state.v, i));
  }
  for (std::size_t b = 0; b < network.bodies.size(); ++b) {
    partition::LocalBody& body = network.bodies[b];
    body.start = bodies::rotation_state(body.properties.rotation, state.bodies[b].attitude, Vector3::Zero());
  }
}

}   // namespace cablenet::system
