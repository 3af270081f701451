#include "cablenet/solve/static_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cablenet/elements/cable.hpp"
#include "cablenet/solve/bed_lay.hpp"
#include "vector_sums.hpp"

namespace cablenet::solve {
namespace {

using petsc::check;

/// The most that the stiffness of a node's contact may be of an element's, until both are as they are.  So soft a bed
/// keeps the number of iterations from growing with the bed's stiffness or with the number of elements.
constexpr double bed_over_cables = 1e-4;

/// Likewise where cables are softened, too.
constexpr double bed_over_soft_cables = 0.01;

/// The most that a bed is softened.  It is reached where the cables carry next to nothing.
constexpr double softest_bed = 1e12;

/// From how far away, over the network's extent, what moves along the bed has come.  It slips there.
constexpr double come_from = 1e9;

/// Sets the bodies' and nodes' velocities.
void fill_velocity(const partition::LocalNetwork& network, const Vector3& velocity, Vec v) {
  double* values = nullptr;
  check(VecSet(v, 0));
  check(VecGetArray(v, &values));
  for (LocalNode node(0); network.is_owned(node); ++node)
    Eigen::Map<Vector3>(values + network.begin[node].value()) = velocity;
  check(VecRestoreArray(v, &values));
}

/// The largest stiffness x area x L of cables and of spots.  It is the stiffness of a node's contact over the element's
/// EA/L, times EA.  [N]
std::array<double, 2> measure_bed(const partition::LocalNetwork& network, MPI_Comm communicator) {
  if (!network.surroundings.bed) return {0, 0};
  double largest[3] = {0, 0, 0};   // of diameter x L^2, a spot's area, and L
  for (int i = 0; i < network.own_elements; ++i) {
    const partition::LocalElement& e = network.elements[at(i)];
    largest[0] = std::max(largest[0], network.surroundings.on_bed[at(e.material)].diameter * e.length * e.length);
    largest[2] = std::max(largest[2], e.length);
  }
  for (const auto& spot : network.bed_spots) largest[1] = std::max(largest[1], spot.area);
  MPI_Allreduce(MPI_IN_PLACE, largest, 3, MPI_DOUBLE, MPI_MAX, communicator);
  const double stiffness = network.surroundings.bed->stiffness;
  return {stiffness * largest[0], stiffness * largest[1] * largest[2]};
}

double softest_cable(const partition::LocalNetwork& network) {
  double least = std::numeric_limits<double>::max();
  for (const auto& material : network.materials) least = std::min(least, material.axial_stiffness);
  return least;
}

}   // namespace

StaticForces::StaticForces(system::Assembler& assembler, double t, const Vector3& velocity)
    : assembler_(assembler),
      t_(t),
      velocity_(velocity),
      stiffest_bed_(measure_bed(assembler.network(), assembler.communicator())),
      softest_cable_(softest_cable(assembler.network())),
      v_(assembler.make_vector()),
      resting_(assembler.make_vector()),
      drag_(assembler.make_vector()),
      scratch_(assembler.make_vector()) {
  fill_velocity(assembler_.network(), velocity_, v_);
}

bool StaticForces::may_push() const {
  const partition::LocalNetwork& network = assembler_.network();
  int found = !network.links.empty() || std::any_of(network.materials.begin(), network.materials.end(),
                                                    [](const auto& material) { return !material.tension_only; });
  MPI_Allreduce(MPI_IN_PLACE, &found, 1, MPI_INT, MPI_LOR, assembler_.communicator());
  return found != 0;
}

bool StaticForces::is_in_flow() const {
  const auto& fluid = assembler_.network().surroundings.fluid;
  if (!fluid || is_stilled_) return false;
  const auto flows = [](const environment::CurrentLayer& layer) { return !layer.velocity.isZero(0); };
  return !velocity_.isZero(0) || std::any_of(fluid->current.begin(), fluid->current.end(), flows);
}

/// Against soft cables a hard bed is a wall, before which Newton's steps shrink to nothing.
double StaticForces::bed_softness(const system::StaticRule& rule, double stiffest) const {
  if (rule.kind == system::StaticRule::Kind::exact) return 1;
  if (rule.kind == system::StaticRule::Kind::descent)
    return std::clamp(stiffest / (bed_over_soft_cables * rule.most_stiffness), 1.0, softest_bed);
  const double cable =
      rule.kind == system::StaticRule::Kind::strings ? rule.string_tension * rule.exponent : softest_cable_;
  return std::clamp(stiffest / (bed_over_cables * cable), 1.0, softest_bed);
}

system::Situation StaticForces::situation(system::InternalForce internal, const system::StaticRule& rule) const {
  return {.stage = {t_, 0, 0},
          .internal = internal,
          .rule = rule,
          .frame = is_still() ? Vector3(0, 0, 0) : velocity_,
          .is_calm = true,
          .is_still = is_still(),
          .bed_softness = bed_softness(rule, stiffest_bed_[0]),
          .spot_softness = bed_softness(rule, stiffest_bed_[1]),
          .sticking = sticking_};
}

void StaticForces::let_stick(Vec x) {
  sticking_ = system::Sticking::as_it_is;
  const partition::LocalNetwork& network = assembler_.network();
  const system::LocalState& state = assembler_.observe(t_, x, v_, resting_);
  system::GripPlaces laid = laid_on_bed(network, network.position, state, assembler_.communicator());
  // What moves along the bed has come from far.
  const Vector3 along(velocity_.x(), velocity_.y(), 0);
  if (!along.isZero(0))
    for (std::optional<Vector3>& place : laid)
      if (place) *place -= come_from * network.extent * along.normalized();
  assembler_.grip_bed(laid);
}

void StaticForces::let_slide() {
  sticking_ = system::Sticking::absent;
  assembler_.grip_bed(system::GripPlaces(assembler_.network().nodes));
}

void StaticForces::hold_friction(Vec x, double share) {
  sticking_ = system::Sticking::measured;
  system::Situation now = situation(system::InternalForce::of_statics, {system::StaticRule::Kind::exact});
  now.measured_share = share;
  assembler_.begin(now, x, v_);
  sticking_ = system::Sticking::held;
}

void StaticForces::let_friction_follow() {
  if (holds_friction()) sticking_ = system::Sticking::as_it_is;
}

std::pair<double, double> StaticForces::measure_drag() {
  PetscReal sum = 0;
  check(VecNorm(drag_, NORM_1, &sum));
  return {sum, norm(drag_)};
}

double StaticForces::drag(Vec x) {
  hold_drag(x);
  let_drag_follow();
  return measure_drag().second;
}

void StaticForces::soften(const system::StaticRule& rule, Vec x) {
  assembler_.begin(situation(system::InternalForce::of_statics, rule), x, v_);
}

void StaticForces::harden(Vec x) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  soften({.kind = system::StaticRule::Kind::descent, .softening = {.ratio = infinite, .over_tension = 0, .least = 1}},
         x);
}

void StaticForces::keep(Vec x) {
  assembler_.begin(situation(system::InternalForce::of_statics, {system::StaticRule::Kind::ropes}), x, v_);
}

bool StaticForces::residual(const system::StaticRule& rule, Vec x, Vec r, system::TangentMatrix* tangent,
                            const Steadying& steadying) {
  const system::Situation now = situation(system::InternalForce::of_statics, rule);
  const Vec v = is_still() ? Vec(resting_) : Vec(v_);
  const auto add_drag = [&] {
    if (holds_drag_) check(VecAXPY(r, 1, drag_));
  };
  if (tangent == nullptr) {
    const bool in_domain = assembler_.evaluate(now, x, v, resting_, r, nullptr);
    add_drag();
    return in_domain;
  }
  const double s = steadying.pseudo_rate;
  const bool is_linear = rule.kind == system::StaticRule::Kind::strings && rule.exponent == 1;
  system::TangentRequest request{
      *tangent, {1, s, s * s}, is_linear, rule.kind == system::StaticRule::Kind::exact ? 0 : steadying.steadiness};
  if (steadying.is_cautious) request.turning.least = 0;
  const bool in_domain = assembler_.evaluate(now, x, v, resting_, r, &request);
  tangent->publish();
  add_drag();
  return in_domain;
}

double StaticForces::potential(const system::StaticRule& rule, Vec x) {
  assembler_.observe(t_, x, v_, resting_);
  double sum = assembler_.potential(situation(system::InternalForce::of_statics, rule));
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, assembler_.communicator());
  return sum;
}

/// The bed is no load.  It answers the other forces, enormously where the drawn shape lies in it.
void StaticForces::loads(Vec x, Vec r) {
  raw_loads(x, r, is_still());
  if (holds_drag_) check(VecAXPY(r, 1, drag_));
}

void StaticForces::raw_loads(Vec x, Vec r, bool is_still) {
  const system::Situation now{.stage = {t_, 0, 0},
                              .internal = system::InternalForce::none,
                              .frame = is_still ? Vector3(0, 0, 0) : velocity_,
                              .is_calm = true,
                              .is_still = is_still,
                              .bed_softness = 0,
                              .spot_softness = 0};
  assembler_.evaluate(now, x, is_still ? resting_ : v_, resting_, r, nullptr);
}

void StaticForces::hold_drag(Vec x, double share) {
  if (!holds_drag_) share = 1;
  holds_drag_ = true;
  check(VecScale(drag_, 1 - share));
  raw_loads(x, scratch_, false);
  check(VecAXPY(drag_, share, scratch_));
  raw_loads(x, scratch_, true);
  check(VecAXPY(drag_, -share, scratch_));
}

double StaticForces::largest_turn(Vec x, Vec y) {
  const partition::LocalNetwork& network = assembler_.network();
  std::vector<Vector3> before(at(network.own_elements));
  const system::LocalState& from = assembler_.observe(t_, x, v_, resting_);
  for (int i = 0; i < network.own_elements; ++i) before[at(i)] = from.chord(network.elements[at(i)]).d;
  double largest = 0;
  const system::LocalState& to = assembler_.observe(t_, y, v_, resting_);
  for (int i = 0; i < network.own_elements; ++i) {
    const partition::LocalElement& e = network.elements[at(i)];
    largest = std::max(largest, (to.chord(e).d - before[at(i)]).norm() / e.length);
  }
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, assembler_.communicator());
  return largest;
}

std::vector<std::pair<int, double>> StaticForces::on_bed(Vec x) {
  const system::LocalState& state = assembler_.observe(t_, x, v_, resting_);
  const partition::LocalNetwork& network = assembler_.network();
  const network::Surroundings& around = network.surroundings;
  std::vector<std::pair<int, double>> found;
  for (int i = 0; around.bed && i < network.own_elements; ++i) {
    const partition::LocalElement& e = network.elements[at(i)];
    const elements::CableMaterial& material = network.materials[at(e.material)];
    const double reach = around.bed->level + around.on_bed[at(e.material)].smoothing;
    const bool lies[2] = {state.position(e.node[0]).z() <= reach, state.position(e.node[1]).z() <= reach};
    if (!lies[0] && !lies[1]) continue;
    const elements::Chord chord = state.chord(e);
    const double displaced = around.fluid ? around.in_water[at(e.material)].displaced : 0;
    const double weight = (material.mass_per_length - displaced) * e.length * network.gravity;
    const double lift = elements::cable_tension(material, e.length, chord) * std::abs(chord.d.z()) / chord.d.norm();
    if (lies[0] && lies[1])
      found.emplace_back(network.scene_element[at(i)], 1);
    else if (lift < weight)
      found.emplace_back(network.scene_element[at(i)], 0);
  }
  return found;
}

std::vector<std::pair<int, double>> StaticForces::pushing(Vec x, double least) {
  const system::LocalState& state = assembler_.observe(t_, x, v_, resting_);
  const partition::LocalNetwork& network = assembler_.network();
  std::vector<std::pair<int, double>> found;
  for (int i = 0; i < network.own_elements; ++i) {
    const partition::LocalElement& e = network.elements[at(i)];
    const double T =
        elements::cable_tension(network.materials[at(e.material)], e.length, {state.chord(e).d, Vector3::Zero()});
    if (-T > least) found.emplace_back(network.scene_element[at(i)], -T);
  }
  return found;
}

std::vector<double> StaticForces::element_tensions(Vec x) {
  const system::LocalState& state = assembler_.observe(t_, x, v_, resting_);
  const partition::LocalNetwork& network = assembler_.network();
  std::vector<double> all;
  for (int i = 0; i < network.own_elements; ++i) {
    const partition::LocalElement& e = network.elements[at(i)];
    all.push_back(
        elements::cable_tension(network.materials[at(e.material)], e.length, {state.chord(e).d, Vector3::Zero()}));
  }
  return all;
}

TensionRange StaticForces::tensions(Vec x) {
  double range[2] = {0, 0};   // the strongest compression, and the largest absolute tension
  for (const double T : element_tensions(x)) {
    range[0] = std::max(range[0], -T);
    range[1] = std::max(range[1], std::abs(T));
  }
  MPI_Allreduce(MPI_IN_PLACE, range, 2, MPI_DOUBLE, MPI_MAX, assembler_.communicator());
  return {-range[0], range[1]};
}

}   // namespace cablenet::solve
