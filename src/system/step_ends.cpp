#include "body_set.hpp"
#include "cablenet/bodies/rigid_body.hpp"
#include "cablenet/system/assembler.hpp"
#include "starts.hpp"

/// What happens at the two ends of a step: prescribed motions, work, and the bodies' end velocities.
namespace cablenet::system {
namespace {

using petsc::check;

Eigen::Map<Vector3> as_vector(double* values) { return Eigen::Map<Vector3>(values); }

/// cos(pitch) one degree from the vertical: before a step leaves the domain of Euler angles.
constexpr double warning_cosine = 0.0175;

}   // namespace

void Assembler::start_prescribed(double t) {
  prescribed_dt_ = -1;
  for (std::size_t i = 0; i < prescribed_.size(); ++i) prescribed_[i].start = network_.prescribed[i].motion.at(t);
}

void Assembler::set_prescribed(const Stage& s) {
  const bool new_end = s.dt != prescribed_dt_;
  const bool midpoint = rule_.scheme == scene::Scheme::energy_momentum;
  prescribed_dt_ = s.dt;
  for (std::size_t i = 0; i < prescribed_.size(); ++i) {
    NodeStep& step = prescribed_[i];
    const auto& [node, motion] = network_.prescribed[i];
    if (new_end) step.end = motion.at(s.t + s.dt);
    const auto& [x0, v0, a0] = step.start;
    const auto& [x1, v1, a1] = step.end;
    NodeMotion& here = outside_[at(node.value() - network_.owned)];
    as_vector(here.x) = x0 + s.alpha_f * (x1 - x0);
    as_vector(here.v) = v0 + s.alpha_f * (v1 - v0);
    // The free nodes' a_a stands for the stage's time t + alpha_f dt.  With the mid-point rule it is (v1 - v0)/dt:
    // taken alike here, the energy of fixed and uniformly moved points balances exactly.
    as_vector(here.a) = midpoint && s.dt > 0 ? Vector3((v1 - v0) / s.dt) : Vector3(a0 + s.alpha_f * (a1 - a0));
  }
}

void Assembler::add_work(const Stage& s) {
  const double stage_t = s.t + s.alpha_f * s.dt;
  const double lag = s.t + 0.5 * s.dt - stage_t;
  // The reaction is known at the stage; work wants it at mid-step.
  const double slope = previous_stage_t_ < stage_t && lag != 0 ? lag / (stage_t - previous_stage_t_) : 0;
  for (std::size_t i = 0; i < prescribed_.size(); ++i) {
    NodeStep& step = prescribed_[i];
    const Vector3 reaction =
        as_vector(outside_r_.data() + 3 * at(network_.prescribed[i].node.value() - network_.owned));
    const bool first = step.previous_reaction.isZero(0);
    const Vector3 middle = first ? reaction : Vector3(reaction + slope * (reaction - step.previous_reaction));
    work_ += middle.dot(step.end.x - step.start.x);
    step.previous_reaction = reaction;
  }
  previous_stage_t_ = stage_t;
}

int Assembler::nearly_singular_body(Vec x) const {
  if (!network_.has_euler_bodies) return -1;
  int found = -1;
  const double* values = nullptr;
  check(VecGetArrayRead(x, &values));
  for (int b = 0; b < network_.own_bodies; ++b) {
    const partition::LocalBody& body = network_.bodies[at(b)];
    bodies::Vector4 y = bodies::Vector4::Zero();
    std::copy_n(values + network_.begin[body.node].value() + 3, bodies::rotation_unknowns(body.properties.rotation),
                y.data());
    if (bodies::distance_from_singular(body.properties.rotation, y) < warning_cosine) found = body.body;
  }
  check(VecRestoreArrayRead(x, &values));
  MPI_Allreduce(MPI_IN_PLACE, &found, 1, MPI_INT, MPI_MAX, communicator_);
  return found;
}

void Assembler::end_step(const Stage& stage, Vec x, Vec v) {
  add_work(stage);
  if (network_.bodies.empty()) return;
  double *x_values = nullptr, *v_values = nullptr;
  check(VecGetArray(x, &x_values));
  check(VecGetArray(v, &v_values));
  work_ += bodies_->end_step(stage, conserves(stage), x_values, v_values);
  check(VecRestoreArray(v, &v_values));
  check(VecRestoreArray(x, &x_values));
}

/// Bodies can be taken from end to end at the mid-point alone, which PETSc's options may shift.  In water they gain
/// nothing by it.
bool Assembler::conserves(const Stage& stage) const {
  return rule_.scheme == scene::Scheme::energy_momentum && stage.dt > 0 && stage.alpha_f == 0.5 &&
         !network_.surroundings.fluid;
}

int Assembler::outside_body() const {
  return bodies_->outside() < 0 ? -1 : network_.bodies[at(bodies_->outside())].body;
}

}   // namespace cablenet::system
