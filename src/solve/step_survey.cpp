#include "cablenet/solve/step_survey.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cablenet/petsc/values.hpp"
#include "cablenet/solve/local_error.hpp"

namespace cablenet::solve {
namespace {

/// A step is looked at whose motion differs by this part of the way from what was expected of it ...
constexpr double event_part = 0.005;
/// ... and of such steps so many, and one in so many.
constexpr long least_events = 64, steps_an_event = 16;
/// A motion may begin suddenly.
constexpr long unseen_steps = 7;

}   // namespace

double StepFindings::share() const {
  if (motion <= 0) return 0;
  return (adds_up() ? 2 * std::numbers::pi / LocalError::memory : 1) * error / motion;
}

double StepFindings::step_for(double wanted) const { return step * std::pow(wanted / share(), 1.0 / order); }

double StepFindings::total_share() const {
  return adds_up() && way > 0 ? total / way * std::min(1.0, counted_ways / ways()) : 0;
}

/// Kinetic energy is proportional to the speed squared.  If a small part q of it is lost, the speed is q/2 too small at
/// the end, and q/4 too small in the mean over the run.
double StepFindings::lag(double lost) const {
  const double counted = std::min(ways(), counted_ways);
  return adds_up() && way > 0 ? lost / 4 * counted * counted / ways() : 0;
}

void StepSurvey::Sum::add(const StepMeans& means, double dt) {
  ++steps;
  error += means.error;
  path += means.speed * dt;
}

bool StepSurvey::is_event(long steps, double correction) const {
  const bool may_look = steps >= unseen_steps && events_.steps < least_events + steps / steps_an_event;
  return may_look && correction > event_part * means_.way() * std::sqrt(network_.free_nodes);
}

void StepSurvey::add_sample(double error, double dt, MPI_Comm communicator, bool is_event) {
  error_ += error;
  (is_event ? events_ : samples_).add(means_.end(communicator), dt);
}

void StepSurvey::add_event(double dt, MPI_Comm communicator) { events_.add(means_.end(communicator), dt); }

void StepSurvey::end_step(long steps, double dt, Vec x) {
  ++steps_;
  shortest_ = shortest_ == 0 ? dt : std::min(shortest_, dt);
  if (!looks_at(steps)) return;
  ++looked_at_;
  step_ += dt;
  const petsc::ReadValues values(x);
  double furthest = 0;
  for (LocalNode node(0); network_.is_owned(node); ++node) {
    const Eigen::Map<const Vector3> here(values + network_.begin[node].value());
    furthest = std::max(furthest, (here - network_.position[node]).squaredNorm());
  }
  motion_ = std::max(motion_, std::sqrt(furthest));
  for (int b = 0; b < network_.own_bodies; ++b) {
    const partition::LocalBody& body = network_.bodies[at(b)];
    motion_ = std::max(motion_, turned_way(body, values + network_.begin[body.node].value() + 3));
  }
}

StepFindings StepSurvey::findings(int order, bool is_adaptive, MPI_Comm communicator) const {
  double motion = motion_;
  MPI_Allreduce(MPI_IN_PLACE, &motion, 1, MPI_DOUBLE, MPI_MAX, communicator);
  const double by = 1 / static_cast<double>(std::max(looked_at_, 1L));
  const double each = static_cast<double>(steps_ - events_.steps) / static_cast<double>(std::max(samples_.steps, 1L));
  StepFindings found{looked_at_, by * error_, by * step_, motion, shortest_, order, is_adaptive, 0, 0, means_.way()};
  found.total = events_.error + each * samples_.error;
  found.path = events_.path + each * samples_.path;
  return found;
}

void StepSurvey::archive(Archive& archive) {
  means_.archive(archive);
  for (Sum* sum : {&events_, &samples_}) {
    archive.item("survey.sum.steps", sum->steps);
    archive.item("survey.sum.error", sum->error);
    archive.item("survey.sum.path", sum->path);
  }
  archive.item("survey.steps", steps_);
  archive.item("survey.looked_at", looked_at_);
  archive.item("survey.error", error_);
  archive.item("survey.step", step_);
  archive.item("survey.motion", motion_);
  archive.item("survey.shortest", shortest_);
}

}   // namespace cablenet::solve
