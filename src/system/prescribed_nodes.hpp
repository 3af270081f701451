#pragma once
#include <limits>
#include <vector>

#include "cablenet/base/archive.hpp"
#include "cablenet/system/situation.hpp"
#include "node_data.hpp"

namespace cablenet::system {

/// The nodes that the scene holds or moves, over a step, and the work that is done by moving them.
class PrescribedNodes {
public:
  explicit PrescribedNodes(const partition::LocalNetwork& network)
      : network_(network), steps_(network.prescribed.size()) {}

  /// Puts the nodes where the situation has them.
  /// @param has_mean_acceleration  the free nodes' acceleration is the step's mean
  void place(const Situation& situation, bool has_mean_acceleration, NodeMotion* outside);
  /// Adds the work of the accepted step, of which these were the last forces on the nodes that are not owned.
  void end_step(const Stage& stage, const double* outside_forces);
  double work() const { return work_; }   ///< since the start [J]
  /// The part of the last step's work that taking the reactions to mid-step has made [J].
  double step_shift() const { return step_shift_; }
  void archive(Archive& archive);

private:
  /// A node at the two ends of the step.
  struct Step {
    scene::Kinematics start, end;
    Vector3 previous_reaction = Vector3::Zero();
  };

  const partition::LocalNetwork& network_;
  std::vector<Step> steps_;
  double start_time_ = std::numeric_limits<double>::quiet_NaN();   ///< of steps_ [s]
  double dt_ = -1;                                                 ///< of the step whose ends steps_ has [s]
  double previous_stage_time_ = 0;
  double work_ = 0, step_shift_ = 0;
};

}   // namespace cablenet::system
