#pragma once
#include <vector>

#include "term.hpp"

namespace cablenet::system {

/// Forces on points that depend on time, in the world's axes: r = -F(t).
/// Their work in a step is F at the middle of the step times the way from its start to its end.
/// Tests: tests/parallel/point_force_test.cpp, tests/verification/point_forces.py
class PointForceTerm : public Term {
public:
  explicit PointForceTerm(const partition::LocalNetwork& network);

  void begin_step(Evaluation& evaluation);
  void add(Evaluation& evaluation);
  void end_step(const StepEnd& end);
  void add_energy(const LocalState&, Energies& sum) const { sum.work += work_; }
  void add_scales(const LocalState&, ForceSums& sums) const;
  Vector3 node_force(const LocalState& state, LocalNode node) const;
  void archive(Archive& archive) { archive.item("work of points' forces", work_); }

private:
  struct ForcedPoint {
    LocalNode node;
    scene::ForceLaw force;
    Vector3 start, stage;   ///< where the node is at the step's start and at its last stage [m]
  };

  std::vector<ForcedPoint> points_;
  double work_ = 0;   ///< since the start [J]
};

}   // namespace cablenet::system
