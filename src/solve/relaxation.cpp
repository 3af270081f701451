#include "cablenet/solve/relaxation.hpp"

#include <algorithm>

#include "cablenet/solve/dynamics.hpp"
#include "cablenet/solve/scheme.hpp"
#include "cablenet/solve/static_forces.hpp"

namespace cablenet::solve {
namespace {

using petsc::check;

/// Parts of the duration: the first step, and the time in which damping by mass takes a speed down to 1/e.
constexpr double first_step = 1e-4, memory = 0.05;

/// A network that has not settled in so many steps hardly settles in more.
constexpr long most_steps = 400;

/// The local error that a step may have, over the network's extent.
constexpr double coarseness = 1e-3;

partition::LocalNetwork in_frame(const system::Assembler& assembler, double t, const Vector3& velocity,
                                 double duration) {
  partition::LocalNetwork network = assembler.network();
  network.held_time = t;
  for (auto& held : network.prescribed) held.motion = scene::Motion::fixed(held.motion.at(t).x);
  for (auto& material : network.materials) {
    material.mass_damping += 1 / (memory * duration);
    material.tension_only = true;
  }
  std::fill(network.velocity.begin(), network.velocity.end(), Vector3::Zero());
  if (auto& bed = network.surroundings.bed; bed && bed->sticks()) bed->friction = 0;
  if (auto& fluid = network.surroundings.fluid) {
    fluid->waves.clear();
    if (fluid->current.empty()) fluid->current.push_back({0, Vector3::Zero()});
    for (auto& layer : fluid->current) layer.velocity -= velocity;
  }
  return network;
}

}   // namespace

double relaxation_tolerance(const partition::LocalNetwork& network) { return coarseness * network.extent; }

bool relax(const system::Assembler& assembler, double t, const Vector3& velocity, double duration,
           StaticProgress& progress, Vec x) {
  scene::Time time;
  time.end = duration;
  time.step = first_step * duration;
  time.scheme = scene::Scheme::generalized_alpha;
  time.spectral_radius = 0;
  time.tolerance = relaxation_tolerance(assembler.network());
  system::Assembler settling(in_frame(assembler, t, velocity, duration), force_rule_of(time), assembler.communicator());
  StaticForces(settling, 0, Vector3::Zero()).start_from(x);
  Dynamics dynamics(settling, time, {duration, relaxation_prefix, most_steps, false, false});
  const auto keep = [&](const Instant& instant) { check(VecCopy(instant.x, x)); };
  const auto watch = [&](double now, double, const Counts&) {
    if (!progress.note_settling(now, duration)) dynamics.stop();
  };
  const Verdict verdict = dynamics.run({keep, watch});
  return verdict != Verdict::failed;
}

}   // namespace cablenet::solve
