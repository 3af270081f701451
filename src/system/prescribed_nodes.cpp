#include "prescribed_nodes.hpp"

namespace cablenet::system {
namespace {

Eigen::Map<Vector3> as_vector(double* values) { return Eigen::Map<Vector3>(values); }

}   // namespace

void PrescribedNodes::start(double t) {
  if (t == start_time_) return;
  start_time_ = t;
  dt_ = -1;
  for (std::size_t i = 0; i < steps_.size(); ++i) steps_[i].start = network_.prescribed[i].motion.at(t);
}

void PrescribedNodes::place_start(const Situation& situation, NodeMotion* outside) {
  start(situation.stage.t);
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    NodeMotion& here = outside[network_.prescribed[i].node.value() - network_.owned];
    as_vector(here.x) = steps_[i].start.x;
    as_vector(here.v) = situation.frame.value_or(steps_[i].start.v);
    as_vector(here.a).setZero();
  }
}

void PrescribedNodes::place(const Situation& situation, bool has_mean_acceleration, NodeMotion* outside) {
  if (situation.frame) return place_start(situation, outside);
  const Stage& s = situation.stage;
  start(s.t);
  const bool is_new_end = s.dt != dt_;
  dt_ = s.dt;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const auto& [node, motion] = network_.prescribed[i];
    if (is_new_end) steps_[i].end = motion.at(s.t + s.dt);
    const auto& [x0, v0, a0] = steps_[i].start;
    const auto& [x1, v1, a1] = steps_[i].end;
    NodeMotion& here = outside[node.value() - network_.owned];
    as_vector(here.x) = x0 + s.alpha_f * (x1 - x0);
    as_vector(here.v) = v0 + s.alpha_f * (v1 - v0);
    // The free nodes' acceleration stands for the time t + alpha_f dt.  Where it is the step's mean, this one is, too:
    // the energy of fixed and uniformly moved points then balances exactly.
    as_vector(here.a) =
        has_mean_acceleration && s.dt > 0 ? Vector3((v1 - v0) / s.dt) : Vector3(a0 + s.alpha_f * (a1 - a0));
  }
}

/// The reaction is known at the stage, and work wants it at mid-step.
void PrescribedNodes::end_step(const Stage& stage, const double* outside_forces) {
  const double lag = stage.t + 0.5 * stage.dt - stage.time(), since = stage.time() - previous_stage_time_;
  const double slope = since > 0 && lag != 0 ? lag / since : 0;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    Step& step = steps_[i];
    const double* const force =
        outside_forces + 3 * std::ptrdiff_t{network_.prescribed[i].node.value() - network_.owned};
    const Vector3 reaction = Eigen::Map<const Vector3>(force);
    const bool is_first = step.previous_reaction.isZero(0);
    const Vector3 middle = is_first ? reaction : Vector3(reaction + slope * (reaction - step.previous_reaction));
    work_ += middle.dot(step.end.x - step.start.x);
    step.previous_reaction = reaction;
  }
  previous_stage_time_ = stage.time();
}

void PrescribedNodes::archive(Archive& archive) {
  archive.item("last stage's time", previous_stage_time_);
  archive.item("work of moved points", work_);
  for (Step& step : steps_) archive.item("reaction", step.previous_reaction);
}

}   // namespace cablenet::system
