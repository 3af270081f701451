#include "energy_accounts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cablenet/bodies/body_in_water.hpp"
#include "cablenet/system/losses.hpp"

namespace cablenet::system {
namespace {

using Const3 = Eigen::Map<const Vector3>;

}   // namespace

EnergyAccounts::Undamped::Undamped(const partition::LocalNetwork& damped)
    : network([&] {
        partition::LocalNetwork copy = damped;
        for (auto& material : copy.materials) material.axial_damping = material.mass_damping = 0;
        return copy;
      }()),
      term(network) {}

EnergyAccounts::EnergyAccounts(const partition::LocalNetwork& network, MPI_Comm communicator, Vector scratch,
                               Vector resting)
    : network_(network), scratch_(std::move(scratch)), resting_(std::move(resting)), record_(communicator, true) {
  if (std::any_of(network.materials.begin(), network.materials.end(), is_damped))
    undamped_ = std::make_unique<Undamped>(network);
}

void EnergyAccounts::keep_start(const LocalState& state, const Energies& stored) {
  stored_ = stored;
  way_ = state.x;
  spins_.clear();
  for (const BodyState& body : state.bodies) spins_.push_back(body.w);
  is_open_ = true;
}

void EnergyAccounts::open(const LocalState& start, const Energies& stored, double prescribed_work) {
  keep_start(start, stored);
  if (std::exchange(has_begun_, true)) return;
  taken_.start = stored.total() - prescribed_work;
  summarise(stored, prescribed_work);
}

void EnergyAccounts::begin_step(Evaluation& evaluation) {
  if (undamped_) undamped_->term.begin_step(evaluation);
}

void EnergyAccounts::end_step(const StepEnd& end) {
  if (undamped_) undamped_->term.end_step(end);
}

void EnergyAccounts::measure(const LocalState& end) {
  std::transform(end.x.begin(), end.x.end(), way_.begin(), way_.begin(), std::minus<>());
}

StepWork EnergyAccounts::work(const NodeData& data) const {
  const AnyNodes nodes{data};
  StepWork sum;
  const auto add = [&](LocalNode node) {
    const Vector3 force = nodes.r(node);
    sum.path += force.dot(Const3(way_.data() + 3 * at(node)));
    sum.power += force.dot(nodes.v(node));
  };
  for (LocalNode node(0); network_.is_owned(node); ++node) add(node);
  for (const auto& held : network_.prescribed) add(held.node);
  // All forces on this rank's bodies are here, and those on other ranks' bodies are there.
  for (std::size_t b = 0; b < at(network_.own_bodies); ++b) {
    const partition::LocalBody& body = network_.bodies[b];
    const Const3 centre(way_.data() + 3 * at(body.node));
    for (int k = body.first_carried; k < body.first_carried + body.carried; ++k) {
      const LocalNode node = network_.carried[at(k)].node;
      add(node);
      sum.turning += nodes.r(node).dot(Const3(way_.data() + 3 * at(node)) - centre);
    }
  }
  return sum;
}

/// What an account takes in a step.  The last stage's power and this one's give that at the step's middle.
double EnergyAccounts::at_middle(std::size_t account, const Stage& stage, const StepWork& work) {
  const double before = std::exchange(power_[account], work.power);
  const double lag = stage.t + 0.5 * stage.dt - stage.time(), since = stage.time() - previous_stage_time_;
  if (stage.alpha_f == 0.5 || steps_ == 0 || since <= 0) return work.path;
  return stage.dt * (work.power + lag / since * (work.power - before));
}

/// By the water, from this rank's bodies: against their turning, and for the water that turns with them.
double EnergyAccounts::taken_from_turning(double dt, const LocalState& end) const {
  double sum = 0;
  for (std::size_t b = 0; b < at(network_.own_bodies); ++b) {
    const partition::LocalBody& body = network_.bodies[b];
    const Vector3 &w0 = spins_[b], &w1 = end.bodies[b].w;
    sum += dt * bodies::turning_drag_power(body.properties, 0.5 * (w0 + w1));
    if (body.water) sum += 0.5 * body.water->added_inertia.dot(w1.cwiseAbs2() - w0.cwiseAbs2());
  }
  return sum;
}

void EnergyAccounts::close(const StepRecord& step, const LocalState& end, const Energies& stored) {
  const auto& [stage, with_damping, undamped, water, bed, prescribed_work, shift] = step;
  const StepWork damper{with_damping.path - undamped.path, 0, with_damping.power - undamped.power};
  const double damping = at_middle(0, stage, damper);
  const double by_water = at_middle(1, stage, water) + taken_from_turning(stage.dt, end);
  const double by_bed = at_middle(2, stage, bed);
  double rest = shift - (stored.total() - stored_.total()) - damping - by_water - by_bed;
  for (const StepWork* work : {&with_damping, &water, &bed}) rest += work->path - work->turning;
  taken_.dissipated += rest;
  taken_.damping += damping;
  taken_.water += by_water;
  taken_.bed += by_bed;
  previous_stage_time_ = stage.time();
  ++steps_;
  keep_start(end, stored);
  summarise(stored, prescribed_work);
}

void EnergyAccounts::add_to(Energies& sum) const {
  sum.dissipated = taken_.dissipated;
  sum.damping = taken_.damping;
  sum.water = taken_.water;
  sum.bed = taken_.bed;
  // Before the first step any state is the start.
  if (has_begun_) sum.start = taken_.start;
}

void EnergyAccounts::summarise(const Energies& stored, double prescribed_work) {
  Energies now = stored;
  now.work += prescribed_work;
  add_to(now);
  record_.add(now);
}

/// What is known of the step's start is found again, as a run that loads has to do it.
void EnergyAccounts::archive(Archive& archive) {
  is_open_ = false;
  if (undamped_) undamped_->term.archive(archive);
  archive.item("accounts.begun", has_begun_);
  archive.item("accounts.steps", steps_);
  archive.item("accounts.taken", taken_.dissipated);
  archive.item("accounts.taken", taken_.damping);
  archive.item("accounts.taken", taken_.water);
  archive.item("accounts.taken", taken_.bed);
  archive.item("accounts.start", taken_.start);
  archive.item("accounts.power", std::span(power_));
  archive.item("accounts.last stage's time", previous_stage_time_);
  record_.archive(archive);
}

}   // namespace cablenet::system
