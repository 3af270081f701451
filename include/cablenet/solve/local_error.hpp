#pragma once
#include <petscvec.h>

#include <span>
#include <vector>

#include "cablenet/base/archive.hpp"
#include "cablenet/bodies/body_data.hpp"
#include "cablenet/partition/local_network.hpp"
#include "cablenet/solve/jerk.hpp"
#include "cablenet/solve/motion_means.hpp"

namespace cablenet::bodies {
struct Start;
}

namespace cablenet::solve {

/// The start of a step.
struct StepStart {
  Vec x;                 ///< [m]
  Vec v;                 ///< [m/s]
  Vec a;                 ///< the acceleration that is kept: as AlphaStepper::a() [m/s^2]
  Vec expected_a;        ///< a guess of the step's mean acceleration, by those of the steps before [m/s^2]
  Vec own_a = nullptr;   ///< the method's own acceleration, where it is centred and x1 depends on it; else null [m/s^2]
};

struct OpenStep;

/// How a body turns in a step, of which a step errs by constant dt^3 |jerk|.
struct Turning {
  double constant;
  Vector3 w;      ///< [rad/s]
  Vector3 jerk;   ///< [rad/s^3]
};

/// The local error of a step: the distance by which this step alone leads a node or a body's attachments astray.
///   error of a node = |beta + (alpha_f - alpha_m)/2 - 1/6| dt^3 |x'''|
///   error of a body = L dt^3 |w'' - w x w'|/12   after a conserving step (rigid_body.hpp)
///                   = L |rates e|                after other steps, e as for a node, of the unknowns of its attitude
/// L is LocalBody::reach.  The largest error of any node and body counts.
///
/// x''' and w'' follow from the accelerations that are kept of this step and of those before (jerk.hpp).
///
/// Where there is no water the errors of steps add up, period by period.  So each counts over the time in which the
/// motion turns by `memory`.  The tolerance then bounds the error of a period, within ten times its value, and not that
/// of a step.  Where there is water its drag ends what an error has begun.
///
/// Tests: tests/parallel/adaptive_test.cpp, tests/verification/adaptive.py
class LocalError {
public:
  /// Over which errors add up [rad].
  static constexpr double memory = 3;

  /// @param longest            over which a step's error can count; 0: each counts by itself [s]
  /// @param conserves          Bodies with quaternions take conserving steps.  They do so only at alpha_f = 1/2.
  /// @param axial_dissipation  xi of energy_momentum
  explicit LocalError(double longest = 0, bool conserves = false, double axial_dissipation = 0)
      : longest_(longest), conserves_(conserves), axial_dissipation_(axial_dissipation) {}

  /// Allocates what is kept of the network's nodes and bodies.  Without this call the first estimate allocates it.
  void prepare(const partition::LocalNetwork& network);
  /// Of a step that leads from `start` to x1.  [m]  Collective.
  /// @param growth  of each unknown's kept acceleration in the step before [m/s^2]; empty where it is not to count
  double estimate(const AlphaStep& step, const partition::LocalNetwork& network, const StepStart& start,
                  std::span<const double> growth, Vec x1);
  /// Each estimate from now on adds up here how the masses move, too.
  void add_means_to(MotionMeans& means) { means_ = &means; }
  /// The power of the step's length that the estimate follows.
  int order() const { return longest_ > 0 ? 2 : 3; }
  /// The step is taken, whether it was estimated or not.
  void accept(const AlphaStep& step);
  void archive(Archive& archive);

private:
  double weighed(const Vector3& v, const Vector3& jerk, double dt) const;
  void add_node(const OpenStep& open, LocalNode node, const Curve<Vector3>& path) const;
  void add_turn(const OpenStep& open, const partition::LocalBody& body, const Turning& turning) const;
  double of_nodes(const OpenStep& open) const;
  double of_bodies(const OpenStep& open);
  Turning of_attitude(const OpenStep& open, bodies::Rotation rotation, int first, const bodies::Vector4& y0) const;
  Turning of_turn(const OpenStep& open, std::size_t body, const bodies::Start& start, const Vector3& start_dw,
                  const bodies::Vector4& y1);

  double longest_;   ///< over which a step's error counts [s]
  bool conserves_;
  MotionMeans* means_ = nullptr;
  double axial_dissipation_;
  Table<LocalNode, bool> can_slacken_;   ///< of owned nodes
  KeptSteps kept_;
  /// Of bodies after conserving steps, three of each: the means of w' in the last step, in the one before it, and in
  /// the one that was estimated last.  [rad/s^2]
  std::vector<double> turns_, turns_before_, next_turns_;
  bool is_estimated_ = false;   ///< the running step
  int unknown_turns_ = 0;       ///< Conserving bodies count when so many more steps in a row have been estimated.
};

/// How far a body's farthest attachment is from where the start's attitude had it.  [m]
/// @param unknowns  of the attitude
double turned_way(const partition::LocalBody& body, const double* unknowns);

}   // namespace cablenet::solve
