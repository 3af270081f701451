#include "prescribed_nodes.hpp"

namespace cablenet::system {

void PrescribedNodes::place(const Situation& situation, bool has_mean_acceleration, NodeMotion* outside) {
  const Stage& s = situation.stage;
  const bool is_new_start = s.t != start_time_, is_new_end = is_new_start || s.dt != dt_;
  start_time_ = s.t;
  dt_ = situation.frame ? -1 : s.dt;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const auto& [node, motion] = network_.prescribed[i];
    auto& [start, end, reaction] = steps_[i];
    if (is_new_start) start = motion.at(s.t);
    NodeMotion& here = outside[node.value() - network_.owned];
    if (situation.frame) {
      here = {start.x, *situation.frame, Vector3::Zero()};
      continue;
    }
    if (is_new_end) end = s.dt > 0 ? motion.at(s.t + s.dt) : start;
    here.x = start.x + s.alpha_f * (end.x - start.x);
    here.v = start.v + s.alpha_f * (end.v - start.v);
    // The free nodes' acceleration stands for the time t + alpha_f dt.  Where it is the step's mean, this one is, too:
    // the energy of fixed and uniformly moved points then balances exactly.
    here.a = has_mean_acceleration && s.dt > 0 ? Vector3((end.v - start.v) / s.dt)
                                               : Vector3(start.a + s.alpha_f * (end.a - start.a));
  }
}

/// The reaction is known at the stage, and work wants it at mid-step.
void PrescribedNodes::end_step(const Stage& stage, const double* outside_forces) {
  const double lag = stage.t + 0.5 * stage.dt - stage.time(), since = stage.time() - previous_stage_time_;
  const double slope = since > 0 && lag != 0 ? lag / since : 0;
  step_shift_ = 0;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    Step& step = steps_[i];
    const double* const force =
        outside_forces + 3 * std::ptrdiff_t{network_.prescribed[i].node.value() - network_.owned};
    const Vector3 reaction = Eigen::Map<const Vector3>(force);
    const bool is_first = step.previous_reaction.isZero(0);
    const Vector3 middle = is_first ? reaction : Vector3(reaction + slope * (reaction - step.previous_reaction));
    work_ += middle.dot(step.end.x - step.start.x);
    step_shift_ += (middle - reaction).dot(step.end.x - step.start.x);
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
