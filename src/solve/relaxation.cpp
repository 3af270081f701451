#include "cablenet/solve/relaxation.hpp"

#include <algorithm>

#include "cablenet/petsc/queries.hpp"
#include "cablenet/solve/dynamics.hpp"
#include "cablenet/system/static_forces.hpp"

namespace cablenet::solve {
namespace {

using petsc::check;

/// Of the duration: the first step, and the time in which damping by mass takes a speed down to 1/e.
constexpr double first_step = 1e-4, memory = 0.05;

/// Where it does not settle in so many, it hardly does in more.
constexpr const char* most_steps_option = "-relax_ts_max_steps";
constexpr const char* most_steps = "400";

/// Of the network's size: the local error of a step.
constexpr double coarseness = 1e-3;

partition::LocalNetwork in_frame(const system::Assembler& assembler, double t, const Vector3& velocity,
                                 double duration) {
  partition::LocalNetwork network = assembler.network();
  for (auto& held : network.prescribed) held.motion = scene::Motion::fixed(held.motion.at(t).x);
  for (auto& material : network.materials) {
    material.mass_damping += 1 / (memory * duration);
    material.tension_only = true;
  }
  std::fill(network.velocity.begin(), network.velocity.end(), Vector3::Zero());
  if (auto& fluid = network.surroundings.fluid) {
    fluid->waves.clear();
    if (fluid->current.empty()) fluid->current.push_back({0, Vector3::Zero()});
    for (auto& layer : fluid->current) layer.velocity -= velocity;
  }
  return network;
}

double size_of(const system::Assembler& assembler) {
  double size = 0;
  for (const auto& element : assembler.network().elements) size += element.length;
  MPI_Allreduce(MPI_IN_PLACE, &size, 1, MPI_DOUBLE, MPI_SUM, assembler.communicator());
  return size;
}

}   // namespace

bool relax(const system::Assembler& assembler, double t, const Vector3& velocity, double duration, Vec x) {
  scene::Time time;
  time.end = duration;
  time.step = first_step * duration;
  time.scheme = scene::Scheme::generalized_alpha;
  time.spectral_radius = 0;
  time.tolerance = coarseness * size_of(assembler);
  system::Assembler settling(in_frame(assembler, t, velocity, duration), {time.scheme, 0, elements::Tangent::exact},
                             assembler.communicator());
  system::StaticForces(settling, 0, Vector3::Zero()).start_from(x);
  if (!petsc::has_option(most_steps_option)) check(PetscOptionsSetValue(nullptr, most_steps_option, most_steps));
  Dynamics dynamics(settling, time, duration, "relax_");
  const Verdict verdict = dynamics.run(
      {[&](const Instant& instant) { check(VecCopy(instant.x, x)); }, [](double, double, const Counts&) {}});
  return verdict != Verdict::failed;
}

}   // namespace cablenet::solve
